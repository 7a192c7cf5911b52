use candle_core::{Device, Tensor};
use serde_json::Value;

use super::{Architecture, CnnLstm, Padding, Streams};
use crate::init::Uniform;

/// A tiny network, for fast tests.
fn tiny(streams: Streams, padding: Padding) -> Architecture {
    Architecture {
        streams,
        n_samples: 41,
        n_channels: 3,
        padding,
        filters: [2, 3, 4, 3, 2, 2],
        pools: [2, 3],
        units: [3, 4, 2, 3],
        dense: [5, 4],
        n_outputs: 2,
    }
}

#[test]
fn sizes_are_those_that_the_reference_counts() {
    let v: Value = serde_json::from_str(include_str!("../../../../vectors/k_nn/shapes.json")).unwrap();
    let check = |name: &str, architecture: &Architecture| {
        let golden = &v["params"][name];
        let count = |key: &str| golden[key].as_u64().unwrap() as usize;
        assert_eq!(architecture.n_parameters(), (count("trainable"), count("total")), "{name}");
        let network = CnnLstm::new(architecture.clone(), 1, &Device::Cpu).unwrap();
        assert_eq!(network.parameters.n_numbers(), count("trainable"), "{name}");
    };
    for n_channels in [1, 3, 5] {
        let with = |architecture: Architecture| Architecture { n_channels, ..architecture };
        check(&format!("d{n_channels}_flat320"), &with(Architecture::paper320(5)));
        check(&format!("d{n_channels}_flat1408"), &with(Architecture::literal(5)));
        let padded = Architecture { pools: [2, 2], ..Architecture::paper320(5) };
        check(&format!("d{n_channels}_flat1600"), &with(padded));
    }
    for (name, padding, n_samples) in [
        ("L200_valid", Padding::Valid, 200),
        ("L64_valid", Padding::Valid, 64),
        ("L40_same", Padding::Same, 40),
    ] {
        let architecture = Architecture { padding, n_samples, pools: [2, 2], ..Architecture::paper320(5) };
        assert_eq!(architecture.n_convolved() as u64, v[name]["flat"].as_u64().unwrap(), "{name}");
    }
}

#[test]
fn the_serial_network_has_the_layers_of_the_paper_in_series() {
    // Kernel x inputs x filters and a bias for each filter.
    let convolution = |kernel: usize, n_inputs: usize, n_filters: usize| (kernel * n_inputs + 1) * n_filters;
    let convolutions = convolution(4, 3, 32)
        + convolution(4, 32, 64)
        + convolution(4, 64, 128)
        + convolution(3, 128, 128)
        + convolution(3, 128, 64)
        + convolution(3, 64, 32);
    // Four gates, each with weights of inputs and states and a bias.
    let lstm = |n_inputs: usize, n_units: usize| 4 * n_units * (n_inputs + n_units + 1);
    let memory = lstm(32, 128) + lstm(128, 256) + lstm(256, 256) + lstm(256, 128);
    let dense = |n_inputs: usize, n_units: usize| (n_inputs + 1) * n_units;
    // Scale and shift of the batch normalization, then the dense layers.
    let head = |n: usize| 2 * n + dense(n, 128) + dense(128, 32) + dense(32, 5);
    let n_trainable = convolutions + memory + head(128);
    let architecture = Architecture::serial(5);
    assert_eq!(architecture.n_parameters(), (n_trainable, n_trainable + 2 * 128));
    assert_eq!(n_trainable, 1_341_829);
    // The other rivals are the streams alone: 10 pooled samples of 32 filters, or the last state, whose LSTM layers read
    // three channels.
    let alone = |streams: Streams| Architecture { streams, ..Architecture::paper320(5) }.n_parameters().0;
    assert_eq!(alone(Streams::Convolutions), convolutions + head(320));
    assert_eq!(alone(Streams::Memory), memory - lstm(32, 128) + lstm(3, 128) + head(128));
    let network = CnnLstm::new(architecture, 1, &Device::Cpu).unwrap();
    assert_eq!(network.parameters.n_numbers(), n_trainable);
    // Two more channels only widen the first convolution.
    let three_axes = Architecture::serial(5).with_three_axes();
    assert_eq!((three_axes.n_axes(), Architecture::serial(5).n_axes()), (3, 1));
    assert_eq!(three_axes.n_parameters().0, n_trainable + 2 * 4 * 32);
}

#[test]
fn every_network_returns_one_row_of_attributes_for_each_segment() {
    let paper = Architecture::paper320(5);
    for architecture in [
        Architecture { streams: Streams::Convolutions, ..paper.clone() },
        Architecture { streams: Streams::Memory, ..paper.clone() },
        Architecture::serial(5),
        paper.with_three_axes(),
        Architecture::serial(5).with_three_axes(),
    ] {
        let shape = (2, architecture.n_samples, architecture.n_channels);
        let segments = Tensor::zeros(shape, candle_core::DType::F32, &Device::Cpu).unwrap();
        let network = CnnLstm::new(architecture, 1, &Device::Cpu).unwrap();
        assert_eq!(network.predict(&segments).unwrap().dims(), [2, 5]);
        if network.architecture().streams == Streams::Series {
            assert_eq!(network.convolved(&segments).unwrap().dims(), [2, 44, 32]);
        }
    }
}

#[test]
fn sizes_in_files_of_the_first_version_are_read() {
    let text = r#"{"streams":"both","n_samples":200,"n_channels":3,"padding":"same","filters":[32,64,128,128,64,32],
        "pools":[4,5],"units":[128,256,256,128],"dense":[128,32],"n_outputs":5}"#;
    assert_eq!(serde_json::from_str::<Architecture>(text).unwrap(), Architecture::paper320(5));
    let serial = serde_json::to_value(Architecture::serial(5)).unwrap();
    assert_eq!(serial["streams"], "series");
    assert_eq!(serde_json::from_value::<Architecture>(serial).unwrap(), Architecture::serial(5));
}

#[test]
fn the_network_is_its_definition() {
    for streams in [Streams::Both, Streams::Convolutions, Streams::Memory, Streams::Series] {
        for padding in [Padding::Same, Padding::Valid] {
            let network = CnnLstm::new(tiny(streams, padding), 5, &Device::Cpu).unwrap();
            let segments = Uniform::new(2).within(1.0, 2 * 41 * 3);
            let tensor = Tensor::from_vec(segments.clone(), (2, 41, 3), &Device::Cpu).unwrap();
            let got = network.predict(&tensor).unwrap().to_vec2::<f32>().unwrap();
            for (segment, got) in segments.chunks(41 * 3).zip(got) {
                let rows: Vec<Vec<f64>> =
                    segment.chunks(3).map(|row| row.iter().map(|x| f64::from(*x)).collect()).collect();
                for (got, expected) in got.iter().zip(slow(&network, &rows)) {
                    assert!((f64::from(*got) - expected).abs() < 1e-5, "{streams:?} {padding:?}");
                }
            }
        }
    }
}

/// Slow oracle: the same network sample by sample in double precision.
fn slow(network: &CnnLstm, segment: &[Vec<f64>]) -> Vec<f64> {
    let numbers = |name: &str| -> Vec<f64> {
        let tensor = network.parameters.get(name).unwrap().flatten_all().unwrap();
        tensor.to_vec1::<f32>().unwrap().into_iter().map(f64::from).collect()
    };
    let dense = |x: &[f64], name: &str| -> Vec<f64> {
        let (weights, bias) = (numbers(&format!("{name}.weight")), numbers(&format!("{name}.bias")));
        let n = bias.len();
        (0..n)
            .map(|j| bias[j] + x.iter().enumerate().map(|(i, x)| x * weights[i * n + j]).sum::<f64>())
            .collect()
    };
    let architecture = network.architecture();
    let convolved = || -> Vec<Vec<f64>> {
        let mut x = segment.to_vec();
        for (index, kernel) in [4, 4, 4, 3, 3, 3].into_iter().enumerate() {
            let width = x[0].len();
            let at = |i: isize| {
                usize::try_from(i).ok().and_then(|i| x.get(i).cloned()).unwrap_or(vec![0.0; width])
            };
            let (first, n) = match architecture.padding {
                Padding::Same => (-((kernel - 1) / 2), x.len()),
                Padding::Valid => (0, x.len() + 1 - kernel as usize),
            };
            x = (0..n)
                .map(|i| (0..kernel).flat_map(|k| at(first + i.cast_signed() + k)).collect::<Vec<f64>>())
                .map(|window| dense(&window, &format!("conv{index}")).iter().map(|y| y.max(0.0)).collect())
                .collect();
            let pool = match index {
                1 => architecture.pools[0],
                5 => architecture.pools[1],
                _ => continue,
            };
            x = x
                .chunks_exact(pool)
                .map(|rows| {
                    (0..rows[0].len())
                        .map(|c| rows.iter().map(|row| row[c]).fold(f64::MIN, f64::max))
                        .collect()
                })
                .collect();
        }
        x
    };
    let remembered = |mut x: Vec<Vec<f64>>| -> Vec<f64> {
        for (index, n) in architecture.units.into_iter().enumerate() {
            let weights = numbers(&format!("lstm{index}.state.weight"));
            let (mut state, mut cell) = (vec![0.0; n], vec![0.0; n]);
            for row in &mut x {
                let mut gates = dense(row, &format!("lstm{index}.input"));
                for (j, gate) in gates.iter_mut().enumerate() {
                    *gate += state.iter().enumerate().map(|(i, h)| h * weights[i * 4 * n + j]).sum::<f64>();
                }
                let sigmoid = |x: f64| 1.0 / (1.0 + (-x).exp());
                for unit in 0..n {
                    let [i, f, g, o] = [0, 1, 2, 3].map(|gate| gates[gate * n + unit]);
                    cell[unit] = sigmoid(f) * cell[unit] + sigmoid(i) * g.tanh();
                    state[unit] = sigmoid(o) * cell[unit].tanh();
                }
                row.clone_from(&state);
            }
        }
        x.pop().unwrap()
    };
    let features = match architecture.streams {
        Streams::Both => [convolved().concat(), remembered(segment.to_vec())].concat(),
        Streams::Convolutions => convolved().concat(),
        Streams::Memory => remembered(segment.to_vec()),
        Streams::Series => remembered(convolved()),
    };
    // Initial running statistics: mean 0, variance 1.
    let x: Vec<f64> = features.iter().map(|x| x / 1.001_f64.sqrt()).collect();
    let x: Vec<f64> = dense(&x, "dense0").iter().map(|y| y.max(0.0)).collect();
    let x: Vec<f64> = dense(&x, "dense1").iter().map(|y| y.max(0.0)).collect();
    dense(&x, "output")
}

#[test]
fn slopes_are_those_of_small_steps() {
    check_slopes(tiny(Streams::Both, Padding::Same));
}

#[test]
fn slopes_of_the_serial_network_are_those_of_small_steps() {
    check_slopes(tiny(Streams::Series, Padding::Same));
}

/// Compares the gradient of every tensor with the change of the loss over a small step along it.
fn check_slopes(architecture: Architecture) {
    let mut network = CnnLstm::new(architecture, 8, &Device::Cpu).unwrap();
    let segments =
        Tensor::from_vec(Uniform::new(3).within(1.0, 4 * 41 * 3), (4, 41, 3), &Device::Cpu).unwrap();
    let loss = |network: &mut CnnLstm| {
        network.predict_learning(&segments).unwrap().sqr().unwrap().sum_all().unwrap()
    };
    let gradients = loss(&mut network).backward().unwrap();
    let names: Vec<String> = network.parameters.iter().map(|(name, _)| name.to_owned()).collect();
    for name in names {
        let before = network.parameters.get(&name).unwrap().copy().unwrap();
        let gradient = gradients.get(network.parameters.get(&name).unwrap()).unwrap().clone();
        // A small step along the gradient of this tensor.
        let square: f32 = gradient.sqr().unwrap().sum_all().unwrap().to_scalar().unwrap();
        // The gradient of the first convolution passes every other layer.
        assert!(square > 0.0 || name != "conv0.weight", "no gradient reaches the first layer");
        let step = 2e-3 / f64::from(square.sqrt()).max(1e-6);
        let mut at = |factor: f64| {
            let mut numbers = network.snapshot().unwrap();
            numbers.insert(name.clone(), (&before + (&gradient * (factor * step)).unwrap()).unwrap());
            network.restore(&numbers).unwrap();
            f64::from(loss(&mut network).to_scalar::<f32>().unwrap())
        };
        let (ahead, behind) = (at(1.0), at(-1.0));
        at(0.0);
        let expected = 2.0 * step * f64::from(square);
        // Tolerance for single-precision sums and the kinks of ReLU.
        assert!(
            (ahead - behind - expected).abs() < 0.03 * expected + 2e-5,
            "{name}: {} for {expected}",
            ahead - behind
        );
    }
}

#[test]
fn what_does_not_fit_is_refused() {
    let network = CnnLstm::new(tiny(Streams::Both, Padding::Same), 8, &Device::Cpu).unwrap();
    let wrong = Tensor::zeros((1, 40, 3), candle_core::DType::F32, &Device::Cpu).unwrap();
    assert!(network.predict(&wrong).unwrap_err().to_string().contains("41"));
    let other =
        CnnLstm::new(Architecture { dense: [5, 6], ..tiny(Streams::Both, Padding::Same) }, 8, &Device::Cpu);
    let mut network = network;
    assert!(network.restore(&other.unwrap().snapshot().unwrap()).is_err());
    for architecture in [
        Architecture { n_samples: 0, ..tiny(Streams::Both, Padding::Same) },
        Architecture { n_samples: 8, ..tiny(Streams::Both, Padding::Valid) },
        Architecture { filters: [usize::MAX; 6], ..tiny(Streams::Both, Padding::Valid) },
    ] {
        assert!(!architecture.is_possible());
    }
}
