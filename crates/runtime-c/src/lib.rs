//! Runtime for textures that were exported from Shagreen as runtime tables (`.shgt`): a library with a C interface.
//!
//! Programs in C, C++ and C# use the functions of [`abi`] by `include/shagreen.h`; programs in Rust use
//! [`texture::RuntimeTexture`] and [`synth::runtime_voice::RuntimeVoice`], and firmware uses the crate `shagreen-synth`
//! alone, which links neither `std` nor `alloc`.
//!
//! ```
//! use shagreen_runtime::synth::runtime_table::TableError;
//! use shagreen_runtime::texture::RuntimeTexture;
//!
//! assert_eq!(RuntimeTexture::load(b"my notes").err(), Some(TableError::Foreign));
//! ```
#![deny(unsafe_code)]
#![deny(clippy::undocumented_unsafe_blocks, clippy::multiple_unsafe_ops_per_block)]
#![cfg_attr(test, allow(clippy::unwrap_used, clippy::expect_used, reason = "tests may panic"))]

#[expect(unsafe_code, reason = "the callers of these functions are not written in Rust")]
pub mod abi;
#[expect(unsafe_code, reason = "pointers of callers become references here, after they were checked")]
mod pointers;
pub mod status;
pub mod texture;

/// Rendering without `std`: tables, voices and textures.
pub use shagreen_synth as synth;
