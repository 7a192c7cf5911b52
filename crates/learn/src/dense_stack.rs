//! Dense layers in a row, with rectified linear units between them.

use candle_core::{Device, Tensor};

use crate::dense;
use crate::init::Uniform;
use crate::model_file::{ModelFileError, Numbers};
use crate::parameters::Parameters;

/// Returns new layers of these sizes, inputs and outputs included.
pub(crate) fn fresh(sizes: &[usize], seed: u64, device: &Device) -> Result<Parameters, candle_core::Error> {
    let mut parameters = Parameters::default();
    let mut uniform = Uniform::new(seed);
    for (index, pair) in sizes.windows(2).enumerate() {
        dense::add(&mut parameters, &format!("dense{index}"), [pair[0], pair[1]], &mut uniform, device)?;
    }
    Ok(parameters)
}

/// Returns the output of the layers for rows of inputs.
pub(crate) fn run(
    parameters: &Parameters,
    x: &Tensor,
    n_layers: usize,
) -> Result<Tensor, candle_core::Error> {
    let mut x = x.clone();
    for index in 0..n_layers {
        x = dense::apply(parameters, &format!("dense{index}"), &x)?;
        if index + 1 < n_layers {
            x = x.relu()?;
        }
    }
    Ok(x)
}

/// Returns the layers of a file: its tensors whose names begin with `prefix`.
///
/// # Errors
/// [`ModelFileError::Shape`] unless the file has layers of these sizes. This is checked before any allocation.
pub(crate) fn read(
    numbers: &Numbers,
    prefix: &str,
    sizes: &[usize],
    device: &Device,
) -> Result<Parameters, ModelFileError> {
    let of =
        |(name, tensor): (&String, &Tensor)| Some((name.strip_prefix(prefix)?.to_owned(), tensor.clone()));
    let named: Numbers = numbers.iter().filter_map(of).collect();
    for (index, pair) in sizes.windows(2).enumerate() {
        let name = format!("dense{index}.weight");
        let found = named.get(&name).map(Tensor::dims);
        if found != Some(pair) {
            let what = format!("tensor \"{prefix}{name}\" has the shape {found:?}, needs {pair:?}");
            return Err(ModelFileError::Shape(candle_core::Error::Msg(what)));
        }
    }
    let parameters = fresh(sizes, 0, device)?;
    parameters.restore(&named)?;
    Ok(parameters)
}

/// Adds the layers to the tensors of a file, with names that begin with `prefix`.
pub(crate) fn add_to(
    parameters: &Parameters,
    numbers: &mut Numbers,
    prefix: &str,
) -> Result<(), candle_core::Error> {
    let named = parameters.snapshot()?;
    numbers.extend(named.into_iter().map(|(name, tensor)| (format!("{prefix}{name}"), tensor)));
    Ok(())
}
