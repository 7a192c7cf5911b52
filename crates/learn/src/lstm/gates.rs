//! One forward or backward step of an LSTM layer, with SIMD width selected at run time by `pulp`.

use pulp::{Arch, Simd, WithSimd};

/// Computes gates, cells and states from the gate sums.
pub(super) struct Step<'a> {
    pub(super) n_units: usize,
    /// Input: gate sums. Output: gate activations (sequences × 4 units).
    pub(super) gates: &'a mut [f32],
    /// Cells of the previous step; zero if there is none.
    pub(super) previous: Option<&'a [f32]>,
    pub(super) cells: &'a mut [f32],
    pub(super) states: &'a mut [f32],
}

/// Computes gradients of the gate sums from the gate activations.
pub(super) struct StepBack<'a> {
    pub(super) n_units: usize,
    /// Input: gate activations. Output: gradients of the gate sums.
    pub(super) gates: &'a mut [f32],
    pub(super) previous: Option<&'a [f32]>,
    pub(super) cells: &'a [f32],
    /// Gradient of the states.
    pub(super) states: &'a [f32],
    /// Input: gradient of the cells from later steps. Output: gradient of the cells of the previous step.
    pub(super) cell_gradient: &'a mut [f32],
}

impl Step<'_> {
    pub(super) fn run(self) {
        Arch::new().dispatch(self);
    }
}

impl StepBack<'_> {
    pub(super) fn run(self) {
        Arch::new().dispatch(self);
    }
}

impl WithSimd for Step<'_> {
    type Output = ();

    #[inline(always)]
    #[allow(clippy::inline_always, reason = "code that is not inlined is compiled for the baseline CPU")]
    fn with_simd<S: Simd>(self, _: S) {
        let Self { n_units: n, gates, previous, cells, states } = self;
        let sequences =
            gates.chunks_exact_mut(4 * n).zip(cells.chunks_exact_mut(n)).zip(states.chunks_exact_mut(n));
        for (index, ((gates, cells), states)) in sequences.enumerate() {
            let (i, rest) = gates.split_at_mut(n);
            let (f, rest) = rest.split_at_mut(n);
            let (g, o) = rest.split_at_mut(n);
            for gate in [&mut *i, &mut *f, &mut *o] {
                for x in gate.iter_mut() {
                    *x = sigmoid(*x);
                }
            }
            for x in g.iter_mut() {
                *x = tanh(*x);
            }
            for ((cell, i), g) in cells.iter_mut().zip(&*i).zip(&*g) {
                *cell = i * g;
            }
            if let Some(previous) = previous {
                for ((cell, f), before) in cells.iter_mut().zip(&*f).zip(&previous[index * n..]) {
                    *cell += f * before;
                }
            }
            for ((state, o), cell) in states.iter_mut().zip(&*o).zip(&*cells) {
                *state = o * tanh(*cell);
            }
        }
    }
}

impl WithSimd for StepBack<'_> {
    type Output = ();

    #[inline(always)]
    #[allow(clippy::inline_always, reason = "code that is not inlined is compiled for the baseline CPU")]
    fn with_simd<S: Simd>(self, _: S) {
        let Self { n_units: n, gates, previous, cells, states, cell_gradient } = self;
        for (index, gates) in gates.chunks_exact_mut(4 * n).enumerate() {
            let of_sequence = index * n..(index + 1) * n;
            let (cells, states) = (&cells[of_sequence.clone()], &states[of_sequence.clone()]);
            let cell_gradient = &mut cell_gradient[of_sequence.clone()];
            let previous = previous.map_or(&[][..], |previous| &previous[of_sequence]);
            let (i, rest) = gates.split_at_mut(n);
            let (f, rest) = rest.split_at_mut(n);
            let (g, o) = rest.split_at_mut(n);
            for unit in 0..n {
                let (of_i, of_f, of_g, of_o) = (i[unit], f[unit], g[unit], o[unit]);
                let cell = tanh(cells[unit]);
                let before = if previous.is_empty() { 0.0 } else { previous[unit] };
                let of_cell = cell_gradient[unit] + states[unit] * of_o * (1.0 - cell * cell);
                i[unit] = of_cell * of_g * of_i * (1.0 - of_i);
                f[unit] = of_cell * before * of_f * (1.0 - of_f);
                g[unit] = of_cell * of_i * (1.0 - of_g * of_g);
                o[unit] = states[unit] * cell * of_o * (1.0 - of_o);
                cell_gradient[unit] = of_cell * of_f;
            }
        }
    }
}

/// `1 / (1 + e^-x)` with an error below 2e-7; free of branches and calls, so that it vectorizes.
#[inline(always)]
#[allow(clippy::inline_always, reason = "code that is not inlined is compiled for the baseline CPU")]
pub(super) fn sigmoid(x: f32) -> f32 {
    1.0 / (1.0 + exp(-x))
}

/// `tanh x` with an error below 2e-7.
#[inline(always)]
#[allow(clippy::inline_always, reason = "code that is not inlined is compiled for the baseline CPU")]
pub(super) fn tanh(x: f32) -> f32 {
    1.0 - 2.0 / (1.0 + exp(2.0 * x))
}

/// `e^x` for x within ±87 (clamped beyond): `2^n` through the exponent bits, and a Taylor series for the remainder.
#[inline(always)]
#[allow(clippy::inline_always, reason = "code that is not inlined is compiled for the baseline CPU")]
fn exp(x: f32) -> f32 {
    const LARGEST: f32 = 87.0;
    // Adding and subtracting 1.5 · 2^23 rounds to an integer.
    const ROUND: f32 = 12_582_912.0;
    let x = x.clamp(-LARGEST, LARGEST);
    let scaled = x * std::f32::consts::LOG2_E;
    let whole = (scaled + ROUND) - ROUND;
    // ln 2 in two parts, the first with few digits, so that no precision is lost.
    let rest = x - whole * 0.693_359_4 + whole * 2.121_944_4e-4;
    let series = 1.0
        + rest
            * (1.0
                + rest
                    * (0.5
                        + rest
                            * (1.0 / 6.0
                                + rest * (1.0 / 24.0 + rest * (1.0 / 120.0 + rest * (1.0 / 720.0))))));
    let exponent = (scaled + ROUND).to_bits().wrapping_sub(ROUND.to_bits());
    series * f32::from_bits(exponent.wrapping_add(127) << 23)
}
