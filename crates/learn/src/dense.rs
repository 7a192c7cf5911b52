//! Dense (fully connected) layers.

use candle_core::{Device, Result, Tensor};

use crate::init::Uniform;
use crate::parameters::Parameters;

/// Adds a layer of `n_inputs` × `n_outputs` with Glorot-uniform weights and zero bias.
pub(crate) fn add(
    parameters: &mut Parameters,
    name: &str,
    [n_inputs, n_outputs]: [usize; 2],
    uniform: &mut Uniform,
    device: &Device,
) -> Result<()> {
    let values = uniform.glorot(n_inputs, n_outputs, n_inputs * n_outputs);
    parameters.add(&format!("{name}.weight"), &[n_inputs, n_outputs], values, device)?;
    parameters.add(&format!("{name}.bias"), &[n_outputs], vec![0.0; n_outputs], device)
}

/// Returns the output of the named layer for `x`, whose last dimension holds the inputs.
pub(crate) fn apply(parameters: &Parameters, name: &str, x: &Tensor) -> Result<Tensor> {
    let weights = parameters.get(&format!("{name}.weight"))?;
    let bias = parameters.get(&format!("{name}.bias"))?;
    let mut shape = x.dims().to_vec();
    let (n_inputs, n_outputs) = weights.dims2()?;
    let rows = x.elem_count() / n_inputs;
    let y = x.reshape((rows, n_inputs))?.matmul(weights)?.broadcast_add(bias)?;
    if let Some(last) = shape.last_mut() {
        *last = n_outputs;
    }
    y.reshape(shape)
}
