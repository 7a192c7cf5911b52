//! Part of a leave-one-out evaluation, as a file: computers can each make one, and one of them joins them.

use serde::{Deserialize, Serialize};
use shagreen_core::maths::shard::Shard;
use shagreen_core::space::SpacePoint;
use shagreen_core::space::leave_one_out::{LeaveOneOutPart, LeftOut, Outcome, Plan};

use crate::layout;
use crate::library::{Library, write_library};
use crate::own_json::{HeaderFault, minor_version};
use crate::parser_words::plain;
use crate::project::sha256_hex;

/// Value of the `format` field.
pub const FORMAT: &str = "shagreen-evaluation-part";
/// Version of the format.
pub const VERSION: &str = "1.0";
const VERSION_MAJOR: u32 = 1;

/// Why bytes are not a part of this evaluation.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum EvaluationPartError {
    /// The file has another format.
    #[error("{reason}")]
    Format {
        /// What it is instead.
        reason: String,
    },
    /// The file has an unsupported version.
    #[error("the part has version {found}, but this program reads version {VERSION}; make it again")]
    Version {
        /// Value of the `version` field.
        found: String,
    },
    /// The file is damaged.
    #[error("the part of the evaluation is damaged: {reason}; make it again")]
    Damaged {
        /// What is wrong.
        reason: String,
    },
    /// The part was made with another library, other options or another version of the program.
    #[error(
        "this part is of another evaluation; make it again with the library, the options and the version of Shagreen of the others"
    )]
    Other,
}

#[derive(Serialize, Deserialize)]
struct PartV1 {
    format: String,
    version: String,
    /// [`evaluation_inputs`].
    inputs: String,
    part: usize,
    of: usize,
    n_evaluated: usize,
    reach_db: f64,
    /// Textures by their indices in the library.
    on_hull: Vec<usize>,
    textures: Vec<LeftOutV1>,
}

#[derive(Serialize, Deserialize)]
struct LeftOutV1 {
    texture: usize,
    at: Vec<f64>,
    nearest: usize,
    within_measured: bool,
    outcomes: Vec<OutcomeV1>,
}

#[derive(Serialize, Deserialize)]
struct OutcomeV1 {
    error_db: f64,
    level_error_db: f64,
    shape_error_db: f64,
    rank: usize,
    nrs: Option<f64>,
    signal_error_db: Option<f64>,
    signal_from_model_db: Option<f64>,
}

/// Returns the hash of everything that an evaluation depends on, in hexadecimal digits.
pub fn evaluation_inputs(library: &Library, plan: &Plan, created_by: &str) -> String {
    let library = sha256_hex(&write_library(library));
    sha256_hex(format!("{library} {plan:?} {created_by}").as_bytes())
}

/// Returns the bytes of a part; `inputs` is its [`evaluation_inputs`].
pub fn write_evaluation_part(part: &LeaveOneOutPart, inputs: &str) -> Vec<u8> {
    let outcome = |outcome: &Outcome| OutcomeV1 {
        error_db: outcome.error_db,
        level_error_db: outcome.level_error_db,
        shape_error_db: outcome.shape_error_db,
        rank: outcome.rank,
        nrs: outcome.nrs,
        signal_error_db: outcome.signal_error_db,
        signal_from_model_db: outcome.signal_from_model_db,
    };
    let left_out = |left: &LeftOut| LeftOutV1 {
        texture: left.texture,
        at: left.at.coordinates().to_vec(),
        nearest: left.nearest,
        within_measured: left.is_within_measured,
        outcomes: left.outcomes.iter().map(outcome).collect(),
    };
    let wire = PartV1 {
        format: FORMAT.to_owned(),
        version: VERSION.to_owned(),
        inputs: inputs.to_owned(),
        part: part.shard.number(),
        of: part.shard.of(),
        n_evaluated: part.n_evaluated,
        reach_db: part.reach_db,
        on_hull: part.on_hull.clone(),
        textures: part.textures.iter().map(left_out).collect(),
    };
    layout::to_bytes(&wire, 2)
}

/// Reads a part of the evaluation with these [`evaluation_inputs`] in a library of `n_textures`.
///
/// # Errors
/// See [`EvaluationPartError`].
pub fn read_evaluation_part(
    bytes: &[u8],
    inputs: &str,
    n_textures: usize,
) -> Result<LeaveOneOutPart, EvaluationPartError> {
    minor_version(bytes, FORMAT, VERSION_MAJOR)?;
    let damaged = |reason: String| EvaluationPartError::Damaged { reason };
    let wire: PartV1 = serde_json::from_slice(bytes).map_err(|error| damaged(plain(&error.to_string())))?;
    if wire.inputs != inputs {
        return Err(EvaluationPartError::Other);
    }
    let shard = Shard::new(wire.part, wire.of).map_err(|error| damaged(error.to_string()))?;
    let outcome = |wire: OutcomeV1| Outcome {
        error_db: wire.error_db,
        level_error_db: wire.level_error_db,
        shape_error_db: wire.shape_error_db,
        rank: wire.rank,
        nrs: wire.nrs,
        signal_error_db: wire.signal_error_db,
        signal_from_model_db: wire.signal_from_model_db,
    };
    let mut textures = Vec::with_capacity(wire.textures.len());
    for left in wire.textures {
        if left.texture.max(left.nearest) >= n_textures {
            return Err(damaged(format!("the library has no texture {}", left.texture.max(left.nearest))));
        }
        let at = SpacePoint::of(&left.at).map_err(|error| damaged(error.to_string()))?;
        textures.push(LeftOut {
            texture: left.texture,
            at,
            nearest: left.nearest,
            is_within_measured: left.within_measured,
            outcomes: left.outcomes.into_iter().map(outcome).collect(),
        });
    }
    if let Some(texture) = wire.on_hull.iter().find(|texture| **texture >= n_textures) {
        return Err(damaged(format!("the library has no texture {texture}")));
    }
    Ok(LeaveOneOutPart {
        shard,
        n_evaluated: wire.n_evaluated,
        textures,
        on_hull: wire.on_hull,
        reach_db: wire.reach_db,
    })
}

/// Returns whether bytes are a part of an evaluation, which a newer one may replace.
pub fn is_evaluation_part(bytes: &[u8]) -> bool {
    !matches!(
        minor_version(bytes, FORMAT, VERSION_MAJOR),
        Err(HeaderFault::Format(_) | HeaderFault::Damaged(_))
    )
}

impl From<HeaderFault> for EvaluationPartError {
    fn from(fault: HeaderFault) -> Self {
        match fault {
            HeaderFault::TooDense(reason) | HeaderFault::Damaged(reason) => Self::Damaged { reason },
            HeaderFault::Format(found) => {
                Self::Format { reason: found.instead_of("a part of an evaluation", FORMAT) }
            }
            HeaderFault::Version(found) | HeaderFault::Major(found) => Self::Version { found },
        }
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::{any, proptest};
    use shagreen_core::maths::shard::Shard;
    use shagreen_core::space::SpacePoint;
    use shagreen_core::space::leave_one_out::{LeaveOneOutPart, LeftOut, Outcome, Plan};
    use shagreen_core::texture::blend::Mode;

    use super::{
        EvaluationPartError, evaluation_inputs, is_evaluation_part, read_evaluation_part,
        write_evaluation_part,
    };
    use crate::starter::starter_library;

    fn part() -> LeaveOneOutPart {
        let outcome = Outcome {
            error_db: 1.0 / 3.0,
            level_error_db: 0.1,
            shape_error_db: 2.5,
            rank: 3,
            nrs: Some(0.7),
            signal_error_db: Some(4.0 / 7.0),
            signal_from_model_db: None,
        };
        let left = LeftOut {
            texture: 4,
            at: SpacePoint::of(&[10.0 / 3.0, 70.0]).unwrap(),
            nearest: 24,
            is_within_measured: true,
            outcomes: vec![outcome, Outcome { nrs: None, ..outcome }],
        };
        LeaveOneOutPart {
            shard: Shard::new(2, 3).unwrap(),
            n_evaluated: 2,
            textures: vec![left],
            on_hull: vec![0, 1],
            reach_db: 0.1 + 0.2,
        }
    }

    #[test]
    fn a_part_comes_back_to_the_bit() {
        let bytes = write_evaluation_part(&part(), "ab");
        assert_eq!(read_evaluation_part(&bytes, "ab", 25), Ok(part()));
        assert!(is_evaluation_part(&bytes) && !is_evaluation_part(b"{}") && !is_evaluation_part(b"notes"));
        assert_eq!(read_evaluation_part(&bytes, "cd", 25), Err(EvaluationPartError::Other));
        let text = String::from_utf8(bytes).unwrap();
        for (changed, n_textures, words) in [
            (text.clone(), 24, "no texture 24"),
            (text.replace("\"part\": 2", "\"part\": 5"), 25, "part 5 of 3"),
            (text.replace("\"1.0\"", "\"2.0\""), 25, "version 2.0"),
            (text.replace("shagreen-evaluation-part", "other"), 25, "not a part of an evaluation"),
            (text[..text.len() / 2].to_owned(), 25, "damaged"),
        ] {
            let error = read_evaluation_part(changed.as_bytes(), "ab", n_textures).unwrap_err().to_string();
            assert!(error.contains(words), "{words}: {error}");
        }
    }

    #[test]
    fn other_libraries_and_options_have_other_inputs() {
        let mut library = starter_library().unwrap();
        let plan = Plan { blendings: vec![Mode::Field.into()], signals: None };
        let inputs = evaluation_inputs(&library, &plan, "test");
        assert_eq!(inputs, evaluation_inputs(&library, &plan, "test"));
        let other = Plan { blendings: vec![Mode::Power.into()], signals: None };
        assert_ne!(inputs, evaluation_inputs(&library, &other, "test"));
        assert_ne!(inputs, evaluation_inputs(&library, &plan, "newer"));
        library.textures.pop();
        assert_ne!(inputs, evaluation_inputs(&library, &plan, "test"));
    }

    proptest! {
        #[test]
        fn no_bytes_panic(bytes in proptest::collection::vec(any::<u8>(), 0..200)) {
            let _ = read_evaluation_part(&bytes, "ab", 25);
        }
    }
}
