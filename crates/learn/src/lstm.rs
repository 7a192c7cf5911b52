//! LSTM layer as one fused operation on the CPU.
//!
//! `i, f, o = σ(·)`, `g = tanh(·)` of `x W + b + h U`, in the order i, f, g, o along the last dimension;
//! `c ← f c + i g`, `h ← o tanh c` (S. Hochreiter and J. Schmidhuber 1997, with the forget gate of F. Gers et al. 2000).
//!
//! The input part `x W + b` is one matrix product over all time steps, computed by the caller. The recurrence remains:
//! one small step per sample. With tensor operations, each step costs a dozen allocations and memory passes. Here a
//! single loop runs all steps and keeps the gates for backpropagation.

mod gates;
mod tiles;

use std::sync::{Mutex, PoisonError};

use candle_core::backend::BackendStorage as _;
use candle_core::{CpuStorage, CustomOp2, Layout, Result, Shape, Tensor, bail};
use ndarray::linalg::general_mat_mul;
use ndarray::{ArrayView2, ArrayViewMut2, Axis};

use crate::lstm::gates::{Step, StepBack};
use crate::lstm::tiles::Tiles;

/// Batch size below which [`Exactness::Sixteen`] multiplies row by row: packing the matrix would take longer.
const LEAST_BATCH_TO_PACK: usize = 4;

/// Precision of the recurrent matrix product.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Exactness {
    /// Single precision.
    Full,
    /// 16-bit weights for small batches: faster, with errors of about 1e-5 of the largest weight of each unit.
    Sixteen,
}

/// Returns the states `h` of all steps (steps × sequences × units), starting from zero states and cells.
///
/// `gate_inputs` is the input part of the gates (steps × sequences × 4 units), `state_weights` the recurrent weights
/// (units × 4 units).
///
/// # Errors
/// Shapes that do not match, or tensors that are not `f32`.
pub(crate) fn lstm(gate_inputs: &Tensor, state_weights: &Tensor, exactness: Exactness) -> Result<Tensor> {
    let (n_steps, n_sequences, n_gates) = gate_inputs.dims3()?;
    let (n_units, n_columns) = state_weights.dims2()?;
    if n_gates != 4 * n_units || n_columns != n_gates {
        bail!("gates of {n_gates} and weights of {n_units} x {n_columns} do not fit");
    }
    if gate_inputs.device().is_cpu() {
        let op = Lstm { n_steps, n_sequences, n_units, exactness, kept: Mutex::new(None) };
        return gate_inputs.contiguous()?.apply_op2(&state_weights.contiguous()?, op);
    }
    step_by_step(gate_inputs, state_weights)
}

/// The same layer with tensor operations, for other devices and as a test oracle.
fn step_by_step(gate_inputs: &Tensor, state_weights: &Tensor) -> Result<Tensor> {
    let (n_steps, n_sequences, _) = gate_inputs.dims3()?;
    let n_units = state_weights.dim(0)?;
    let mut state = Tensor::zeros((n_sequences, n_units), gate_inputs.dtype(), gate_inputs.device())?;
    let mut cell = state.clone();
    let mut states = Vec::with_capacity(n_steps);
    for step in 0..n_steps {
        let gates = (gate_inputs.get(step)? + state.matmul(state_weights)?)?;
        let gates = gates.chunk(4, 1)?;
        let [i, f, g, o] = &gates[..] else { bail!("an LSTM layer has four gates") };
        let (i, f, o) =
            (candle_nn::ops::sigmoid(i)?, candle_nn::ops::sigmoid(f)?, candle_nn::ops::sigmoid(o)?);
        cell = ((f * cell)? + (i * g.tanh()?)?)?;
        state = (o * cell.tanh()?)?;
        states.push(state.clone());
    }
    Tensor::stack(&states, 0)
}

struct Lstm {
    n_steps: usize,
    n_sequences: usize,
    n_units: usize,
    exactness: Exactness,
    /// Activations of the forward pass, kept for the backward pass.
    kept: Mutex<Option<Kept>>,
}

struct Kept {
    /// Gate activations (steps × sequences × 4 units).
    gates: Vec<f32>,
    /// Cells (steps × sequences × units).
    cells: Vec<f32>,
}

impl CustomOp2 for Lstm {
    fn name(&self) -> &'static str {
        "lstm"
    }

    fn cpu_fwd(
        &self,
        inputs: &CpuStorage,
        inputs_layout: &Layout,
        weights: &CpuStorage,
        weights_layout: &Layout,
    ) -> Result<(CpuStorage, Shape)> {
        let Self { n_steps, n_sequences, n_units, .. } = *self;
        let mut gates = floats(inputs, inputs_layout)?.to_vec();
        let weights = floats(weights, weights_layout)?;
        let (of_step, n_gates) = (n_sequences * n_units, 4 * n_units);
        let is_quick = self.exactness == Exactness::Sixteen && n_sequences < LEAST_BATCH_TO_PACK;
        let mut tiles = is_quick.then(|| Tiles::of(weights, n_gates));
        let mut states = vec![0.0; n_steps * of_step];
        let mut cells = vec![0.0; n_steps * of_step];
        for step in 0..n_steps {
            let gates = &mut gates[4 * step * of_step..][..4 * of_step];
            let (before, now) = states.split_at_mut(step * of_step);
            let (cells_before, cells) = cells.split_at_mut(step * of_step);
            let mut previous = None;
            if step > 0 {
                let state = &before[(step - 1) * of_step..];
                match &mut tiles {
                    Some(tiles) => {
                        for (state, gates) in state.chunks_exact(n_units).zip(gates.chunks_exact_mut(n_gates))
                        {
                            tiles.add_product(state, gates);
                        }
                    }
                    None => multiply(state, weights, gates, [n_sequences, n_units, n_gates])?,
                }
                previous = Some(&cells_before[(step - 1) * of_step..]);
            }
            Step { n_units, gates, previous, cells: &mut cells[..of_step], states: &mut now[..of_step] }
                .run();
        }
        *self.kept.lock().unwrap_or_else(PoisonError::into_inner) = Some(Kept { gates, cells });
        Ok((CpuStorage::F32(states), Shape::from((n_steps, n_sequences, n_units))))
    }

    fn bwd(
        &self,
        inputs: &Tensor,
        weights: &Tensor,
        states: &Tensor,
        states_gradient: &Tensor,
    ) -> Result<(Option<Tensor>, Option<Tensor>)> {
        let Self { n_steps, n_sequences, n_units, .. } = *self;
        let mut kept = self.kept.lock().unwrap_or_else(PoisonError::into_inner);
        let Some(Kept { mut gates, cells }) = kept.take() else {
            bail!("the backward pass of an LSTM layer runs only once");
        };
        let (of_step, n_gates) = (n_sequences * n_units, 4 * n_units);
        let wanted = states_gradient.flatten_all()?.to_vec1::<f32>()?;
        let states = states.flatten_all()?.to_vec1::<f32>()?;
        let weight_values = weights.flatten_all()?.to_vec1::<f32>()?;
        let weight_rows = view(&weight_values, [n_units, n_gates])?;
        let (mut from_later, mut cell_gradient) = (vec![0.0_f32; of_step], vec![0.0_f32; of_step]);
        for step in (0..n_steps).rev() {
            for (later, wanted) in from_later.iter_mut().zip(&wanted[step * of_step..]) {
                *later += wanted;
            }
            // The gate buffer is overwritten by the gate gradients.
            let gates = &mut gates[4 * step * of_step..][..4 * of_step];
            let previous = step.checked_sub(1).map(|before| &cells[before * of_step..][..of_step]);
            let cells = &cells[step * of_step..][..of_step];
            StepBack {
                n_units,
                gates,
                previous,
                cells,
                states: &from_later,
                cell_gradient: &mut cell_gradient,
            }
            .run();
            if step > 0 {
                let gates = view(gates, [n_sequences, n_gates])?;
                let mut before = view_mut(&mut from_later, [n_sequences, n_units])?;
                general_mat_mul(1.0, &gates, &weight_rows.t(), 0.0, &mut before);
            }
        }
        let mut weight_gradient = vec![0.0; n_units * n_gates];
        if n_steps > 1 {
            let rows = (n_steps - 1) * n_sequences;
            let before = view(&states[..rows * n_units], [rows, n_units])?;
            let later = view(&gates, [n_steps * n_sequences, n_gates])?;
            let mut into = view_mut(&mut weight_gradient, [n_units, n_gates])?;
            let (_, later) = later.split_at(Axis(0), n_sequences);
            general_mat_mul(1.0, &before.t(), &later, 0.0, &mut into);
        }
        let device = inputs.device();
        Ok((
            Some(Tensor::from_vec(gates, (n_steps, n_sequences, n_gates), device)?),
            Some(Tensor::from_vec(weight_gradient, (n_units, n_gates), device)?),
        ))
    }
}

/// Adds `states × weights` to the gates.
fn multiply(
    states: &[f32],
    weights: &[f32],
    gates: &mut [f32],
    [n_sequences, n_units, n_gates]: [usize; 3],
) -> Result<()> {
    let states = view(&states[..n_sequences * n_units], [n_sequences, n_units])?;
    let weights = view(weights, [n_units, n_gates])?;
    general_mat_mul(1.0, &states, &weights, 1.0, &mut view_mut(gates, [n_sequences, n_gates])?);
    Ok(())
}

fn view(values: &[f32], [rows, columns]: [usize; 2]) -> Result<ArrayView2<'_, f32>> {
    ArrayView2::from_shape((rows, columns), values).map_err(candle_core::Error::wrap)
}

fn view_mut(values: &mut [f32], [rows, columns]: [usize; 2]) -> Result<ArrayViewMut2<'_, f32>> {
    ArrayViewMut2::from_shape((rows, columns), values).map_err(candle_core::Error::wrap)
}

/// Returns the values of a contiguous tensor.
fn floats<'a>(storage: &'a CpuStorage, layout: &Layout) -> Result<&'a [f32]> {
    let Some((begin, end)) = layout.contiguous_offsets() else {
        bail!("an LSTM layer needs contiguous tensors")
    };
    let values = storage.as_slice::<f32>()?;
    debug_assert_eq!(storage.dtype(), candle_core::DType::F32, "as_slice checks the type");
    Ok(&values[begin..end])
}

#[cfg(test)]
mod tests;
