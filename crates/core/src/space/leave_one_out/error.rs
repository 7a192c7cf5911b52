//! Why a leave-one-out evaluation fails.

use crate::space::SpaceError;
use crate::space::authoring::{BlendingError, ModelsError};
use crate::space::leave_one_out::MIN_PLACED;
use crate::texture::rate::AtRateError;
use crate::texture::render::RenderError;

/// Reasons why the leave-one-out evaluation fails.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum LeaveOneOutError {
    /// Too few textures have a position.
    #[error(
        "leave-one-out evaluation needs {MIN_PLACED} textures with a position, got {n}; place more of them"
    )]
    TooFew {
        /// Number of textures with a position.
        n: usize,
    },
    /// In a plane, no texture is strictly inside the hull of the others.
    #[error(
        "none of the {n} textures lies strictly inside the convex hull of the others (are all on one line?), so none can be interpolated; place some inside"
    )]
    NoneInside {
        /// Number of textures with a position.
        n: usize,
    },
    /// On one axis, no texture is strictly between two others.
    #[error(
        "none of the {n} textures lies strictly between two others on the axis, so none can be interpolated; place some between"
    )]
    NoneBetween {
        /// Number of textures with a position.
        n: usize,
    },
    /// The mode does not support the interpolation options.
    #[error(transparent)]
    Blending(#[from] BlendingError),
    /// The positions make no space.
    #[error("the positions of the textures are invalid; every coordinate must be a finite number")]
    Space(#[from] SpaceError),
    /// A texture cannot be converted to the sample rate of the others.
    #[error("texture {texture} cannot be converted to the sample rate of the others")]
    Rate {
        /// Library index of the texture.
        texture: usize,
        /// Cause of the failure.
        source: AtRateError,
    },
    /// The remaining textures cannot be interpolated.
    #[error("without texture {texture} the other textures cannot be interpolated")]
    Models {
        /// Library index of the removed texture.
        texture: usize,
        /// Cause of the failure.
        source: ModelsError,
    },
    /// A mode gives no texture at the position.
    #[error("mode {mode} gives no texture at the position of texture {texture}; leave this mode out")]
    Unmade {
        /// Library index of the removed texture.
        texture: usize,
        /// Identifier of the mode.
        mode: &'static str,
    },
    /// A signal cannot be rendered.
    #[error("texture {texture} could not be rendered")]
    Render {
        /// Library index of the removed texture.
        texture: usize,
        /// Cause of the failure.
        source: RenderError,
    },
    /// The caller stopped the evaluation.
    #[error("the leave-one-out evaluation was stopped before it finished")]
    Stopped,
}

impl LeaveOneOutError {
    /// Library index of the texture that the error concerns, if any.
    pub fn texture(&self) -> Option<usize> {
        match self {
            Self::Rate { texture, .. }
            | Self::Models { texture, .. }
            | Self::Unmade { texture, .. }
            | Self::Render { texture, .. } => Some(*texture),
            Self::TooFew { .. }
            | Self::NoneInside { .. }
            | Self::NoneBetween { .. }
            | Self::Blending(_)
            | Self::Space(_)
            | Self::Stopped => None,
        }
    }
}
