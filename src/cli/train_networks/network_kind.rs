//! Networks that can be trained, and the acceleration that they read, by their names on the command line.

use clap::builder::{PossibleValue, PossibleValuesParser, TypedValueParser};
use shagreen_learn::cnn_lstm::Architecture;

/// Network that can be trained.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Network {
    Paper320,
    Literal,
    Convolutions,
    Memory,
    Serial,
}

impl Network {
    const ALL: [Self; 5] = [Self::Paper320, Self::Literal, Self::Convolutions, Self::Memory, Self::Serial];

    pub(super) fn id(self) -> &'static str {
        match self {
            Self::Paper320 => "paper320",
            Self::Literal => "literal",
            Self::Convolutions => "convolutions",
            Self::Memory => "memory",
            Self::Serial => "serial",
        }
    }

    /// Usual name of the architecture, which the command line accepts too.
    fn alias(self) -> Option<&'static str> {
        match self {
            Self::Convolutions => Some("1d-cnn"),
            Self::Memory => Some("lstm"),
            Self::Paper320 | Self::Literal | Self::Serial => None,
        }
    }

    /// Row of the paper's Table 3 to which the network corresponds.
    pub(super) fn method(self) -> &'static str {
        match self {
            Self::Paper320 | Self::Literal => "parallel CNN-LSTM, the network of the paper",
            Self::Convolutions => "1D-CNN",
            Self::Memory => "LSTM",
            Self::Serial => "serial CNN-LSTM",
        }
    }

    pub(super) fn architecture(self, axes: Axes, n_outputs: usize) -> Architecture {
        let architecture = match self {
            Self::Paper320 => Architecture::paper320(n_outputs),
            Self::Literal => Architecture::literal(n_outputs),
            Self::Convolutions => Architecture::convolutions(n_outputs),
            Self::Memory => Architecture::memory(n_outputs),
            Self::Serial => Architecture::serial(n_outputs),
        };
        match axes {
            Axes::Combined => architecture,
            Axes::Three => architecture.with_three_axes(),
        }
    }

    /// Returns a parser of ids and aliases.
    pub(super) fn parser() -> impl TypedValueParser<Value = Self> {
        let words = Self::ALL.map(|network| PossibleValue::new(network.id()).aliases(network.alias()));
        PossibleValuesParser::new(words)
            .try_map(|word| Self::of_word(&word).ok_or_else(|| format!("{word} is unknown")))
    }

    fn of_word(word: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|network| network.id() == word || network.alias() == Some(word))
    }
}

/// Acceleration that a network reads.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Axes {
    /// One signal, combined from all axes by DFT321.
    Combined,
    Three,
}

impl Axes {
    pub(super) const ALL: [Self; 2] = [Self::Combined, Self::Three];

    pub(super) fn id(self) -> &'static str {
        match self {
            Self::Combined => "combined",
            Self::Three => "three",
        }
    }
}

/// Returns the name of a network in results and files.
pub(super) fn name_of(network: Network, axes: Axes) -> String {
    match axes {
        Axes::Combined => network.id().to_owned(),
        Axes::Three => format!("{}-three-axes", network.id()),
    }
}

#[cfg(test)]
mod tests {
    use super::{Axes, Network, name_of};

    #[test]
    fn a_word_names_one_network() {
        for network in Network::ALL {
            assert_eq!(Network::of_word(network.id()), Some(network));
        }
        assert_eq!(Network::of_word("1d-cnn"), Some(Network::Convolutions));
        assert_eq!(Network::of_word("lstm"), Some(Network::Memory));
        assert_eq!(Network::of_word("cnn"), None);
    }

    #[test]
    fn three_axes_have_a_name_and_two_channels_more() {
        for network in Network::ALL {
            assert_ne!(name_of(network, Axes::Three), name_of(network, Axes::Combined));
            assert_eq!(network.architecture(Axes::Combined, 2).n_channels, 3);
            assert_eq!(network.architecture(Axes::Three, 2).n_channels, 5);
        }
    }
}
