//! Trainable parameters of a network, by name.

use std::collections::BTreeMap;

use candle_core::backprop::GradStore;
use candle_core::{Device, Result, Tensor, Var, bail};

/// Trainable parameters, sorted by name.
#[derive(Clone, Debug, Default)]
pub(crate) struct Parameters {
    vars: BTreeMap<String, Var>,
}

impl Parameters {
    /// Adds a parameter tensor from values in row-major order.
    pub(crate) fn add(
        &mut self,
        name: &str,
        shape: &[usize],
        values: Vec<f32>,
        device: &Device,
    ) -> Result<()> {
        let var = Var::from_tensor(&Tensor::from_vec(values, shape, device)?)?;
        self.vars.insert(name.to_owned(), var);
        Ok(())
    }

    /// Returns the tensor with this name.
    pub(crate) fn get(&self, name: &str) -> Result<&Tensor> {
        match self.vars.get(name) {
            Some(var) => Ok(var.as_tensor()),
            None => bail!("the network has no tensor \"{name}\""),
        }
    }

    /// Returns all parameters.
    pub(crate) fn iter(&self) -> impl Iterator<Item = (&str, &Var)> {
        self.vars.iter().map(|(name, var)| (name.as_str(), var))
    }

    /// Returns the total number of values.
    #[cfg(test)]
    pub(crate) fn n_numbers(&self) -> usize {
        self.vars.values().map(|var| var.elem_count()).sum()
    }

    /// Returns a copy that later training does not change.
    pub(crate) fn snapshot(&self) -> Result<BTreeMap<String, Tensor>> {
        self.vars.iter().map(|(name, var)| Ok((name.clone(), var.as_tensor().copy()?))).collect()
    }

    /// Replaces all parameters; names and shapes must match.
    pub(crate) fn restore(&self, from: &BTreeMap<String, Tensor>) -> Result<()> {
        for (name, var) in &self.vars {
            let Some(tensor) = from.get(name) else { bail!("tensor \"{name}\" is missing") };
            if tensor.shape() != var.shape() {
                bail!("tensor \"{name}\" has the shape {:?}, needs {:?}", tensor.shape(), var.shape());
            }
            var.set(&tensor.to_device(var.device())?)?;
        }
        Ok(())
    }
}

/// Settings of Adam (D. Kingma and J. Ba 2015, algorithm 1).
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct AdamConfig {
    pub(crate) learning_rate: f64,
    pub(crate) beta1: f64,
    pub(crate) beta2: f64,
    pub(crate) epsilon: f64,
}

impl AdamConfig {
    /// Returns the usual settings with this learning rate.
    pub(crate) const fn usual(learning_rate: f64) -> Self {
        Self { learning_rate, beta1: 0.9, beta2: 0.999, epsilon: 1e-7 }
    }
}

/// State of the Adam optimizer; candle's own optimizer hides its moments, so training could not be resumed.
#[derive(Clone, Debug)]
pub(crate) struct Adam {
    config: AdamConfig,
    pub(crate) n_steps: usize,
    /// First and second moment of the gradient of each parameter.
    pub(crate) moments: BTreeMap<String, [Tensor; 2]>,
}

impl Adam {
    pub(crate) fn new(config: AdamConfig) -> Self {
        Self { config, n_steps: 0, moments: BTreeMap::new() }
    }

    /// Takes one step down these gradients; parameters without a gradient stay unchanged.
    pub(crate) fn step(&mut self, parameters: &Parameters, gradients: &GradStore) -> Result<()> {
        self.n_steps += 1;
        let AdamConfig { learning_rate, beta1, beta2, epsilon } = self.config;
        let n = self.n_steps as f64;
        let (first, second) = (1.0 - beta1.powf(n), 1.0 - beta2.powf(n));
        for (name, var) in parameters.iter() {
            let Some(gradient) = gradients.get(var) else { continue };
            let gradient = gradient.detach();
            let (mean, square) = match self.moments.get(name) {
                Some([mean, square]) => (
                    ((mean * beta1)? + (&gradient * (1.0 - beta1))?)?,
                    ((square * beta2)? + (gradient.sqr()? * (1.0 - beta2))?)?,
                ),
                None => ((&gradient * (1.0 - beta1))?, (gradient.sqr()? * (1.0 - beta2))?),
            };
            let step = ((&mean * (learning_rate / first))? / ((&square / second)?.sqrt()? + epsilon)?)?;
            var.set(&(var.as_tensor() - step)?.detach())?;
            self.moments.insert(name.to_owned(), [mean, square]);
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::{Adam, AdamConfig, Parameters};
    use candle_core::{Device, Tensor};

    #[test]
    fn adam_is_its_equations() {
        let mut parameters = Parameters::default();
        parameters.add("x", &[2], vec![1.0, -2.0], &Device::Cpu).unwrap();
        let mut adam = Adam::new(AdamConfig::usual(0.1));
        // In double precision, for the loss y·x² with y = (3, 1).
        let (mut x, mut m, mut v) = ([1.0_f64, -2.0], [0.0; 2], [0.0; 2]);
        for step in 1..=5 {
            let scale = Tensor::new(&[3.0_f32, 1.0], &Device::Cpu).unwrap();
            let loss = (parameters.get("x").unwrap().sqr().unwrap() * scale).unwrap().sum_all().unwrap();
            adam.step(&parameters, &loss.backward().unwrap()).unwrap();
            for i in 0..2 {
                let gradient = 2.0 * x[i] * [3.0, 1.0][i];
                m[i] = 0.9 * m[i] + 0.1 * gradient;
                v[i] = 0.999 * v[i] + 0.001 * gradient * gradient;
                let (m_hat, v_hat) = (m[i] / (1.0 - 0.9_f64.powi(step)), v[i] / (1.0 - 0.999_f64.powi(step)));
                x[i] -= 0.1 * m_hat / (v_hat.sqrt() + 1e-7);
            }
        }
        let got = parameters.get("x").unwrap().to_vec1::<f32>().unwrap();
        assert!(got.iter().zip(x).all(|(got, x)| (f64::from(*got) - x).abs() < 1e-6), "{got:?} {x:?}");
    }

    #[test]
    fn numbers_that_do_not_fit_are_refused() {
        let mut one = Parameters::default();
        one.add("x", &[2], vec![1.0, 2.0], &Device::Cpu).unwrap();
        let mut other = Parameters::default();
        assert!(one.restore(&other.snapshot().unwrap()).unwrap_err().to_string().contains("missing"));
        other.add("x", &[1, 2], vec![1.0, 2.0], &Device::Cpu).unwrap();
        assert!(one.restore(&other.snapshot().unwrap()).unwrap_err().to_string().contains("shape"));
        assert!(one.get("y").is_err());
    }
}
