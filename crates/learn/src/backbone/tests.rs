use super::efficientnet::{EfficientNet, N_EARLY, N_LATE};
use super::{Backbone, BackboneError, Depth, Numbers};
use crate::init::Uniform;
use safetensors::tensor::{Dtype, TensorView};
use shagreen_core::surfaces::picture_features::{SIDE, Square};

/// Random weights with the shapes of EfficientNet-Lite0.
fn made_up() -> Numbers {
    let mut numbers = Numbers::new();
    let mut uniform = Uniform::new(4);
    let mut add = |name: String, shape: &[usize], fan: usize| {
        let n = shape.iter().product();
        numbers.insert(name, (shape.to_vec(), uniform.within((3.0 / fan as f32).sqrt(), n)));
    };
    let norm = |add: &mut dyn FnMut(String, &[usize], usize), name: &str, n: usize| {
        for part in ["weight", "bias", "running_mean"] {
            add(format!("{name}.{part}"), &[n], 300);
        }
        add(format!("{name}.running_var"), &[n], 300);
    };
    add("_conv_stem.weight".to_owned(), &[32, 3, 3, 3], 27);
    norm(&mut add, "_bn0", 32);
    let mut n_inputs = 32;
    let blocks =
        [(3, 1, 16), (3, 6, 24), (3, 6, 24), (5, 6, 40), (5, 6, 40), (3, 6, 80), (3, 6, 80), (3, 6, 80)];
    let blocks = blocks.into_iter().chain([(5, 6, 112); 3]).chain([(5, 6, 192); 4]).chain([(3, 6, 320)]);
    for (index, (kernel, factor, n_outputs)) in blocks.enumerate() {
        let name = |part: &str| format!("_blocks.{index}.{part}");
        let n_wide = factor * n_inputs;
        if factor > 1 {
            add(name("_expand_conv.weight"), &[n_wide, n_inputs, 1, 1], n_inputs);
            norm(&mut add, &name("_bn0"), n_wide);
        }
        add(name("_depthwise_conv.weight"), &[n_wide, 1, kernel, kernel], kernel * kernel);
        norm(&mut add, &name("_bn1"), n_wide);
        add(name("_project_conv.weight"), &[n_outputs, n_wide, 1, 1], n_wide);
        norm(&mut add, &name("_bn2"), n_outputs);
        n_inputs = n_outputs;
    }
    for (name, (_, values)) in &mut numbers {
        if name.ends_with("running_var") {
            for value in values {
                *value = 0.5 + value.abs();
            }
        } else if name.contains("_bn") && name.ends_with(".weight") {
            for value in values {
                *value += 1.0;
            }
        }
    }
    numbers
}

fn file(numbers: &Numbers) -> Vec<u8> {
    let bytes: Vec<(String, Vec<usize>, Vec<u8>)> = numbers
        .iter()
        .map(|(name, (shape, values))| {
            (name.clone(), shape.clone(), values.iter().flat_map(|value| value.to_le_bytes()).collect())
        })
        .collect();
    let views = bytes.iter().map(|(name, shape, bytes)| {
        (name.as_str(), TensorView::new(Dtype::F32, shape.clone(), bytes).unwrap())
    });
    safetensors::serialize(views.collect::<Vec<_>>(), None).unwrap()
}

fn square(seed: u64) -> Square {
    Square { rgb: Uniform::new(seed).within(0.5, 3 * SIDE * SIDE).iter().map(|x| 0.5 + x).collect() }
}

/// Slow oracle: the same convolutions as explicit sums in double precision.
mod slow {
    use super::Numbers;

    /// Feature map, channels × side × side.
    pub(super) struct Map {
        pub(super) n: usize,
        pub(super) side: usize,
        pub(super) values: Vec<f64>,
    }

    impl Map {
        fn at(&self, c: usize, y: isize, x: isize) -> f64 {
            let inside = |k: isize| usize::try_from(k).ok().filter(|k| *k < self.side);
            match (inside(y), inside(x)) {
                (Some(y), Some(x)) => self.values[(c * self.side + y) * self.side + x],
                _ => 0.0,
            }
        }
    }

    pub(super) fn conv(
        map: &Map,
        numbers: &Numbers,
        weight: &str,
        stride: usize,
        norm: &str,
        rectify: bool,
    ) -> Map {
        let (shape, values) = &numbers[weight];
        let [n, of, kernel, _] = shape[..] else { panic!("a convolution kernel has four dimensions") };
        let side = map.side.div_ceil(stride);
        let before = (((side - 1) * stride + kernel).saturating_sub(map.side) / 2).cast_signed();
        let part = |part: &str, c: usize| f64::from(numbers[&format!("{norm}.{part}")].1[c]);
        let mut out = Vec::new();
        for o in 0..n {
            let scale = part("weight", o) / (part("running_var", o) + 1e-3).sqrt();
            for y in 0..side {
                for x in 0..side {
                    let mut sum = 0.0;
                    for i in 0..of {
                        // Depthwise convolutions have one input channel per filter.
                        let from = if of == 1 { o } else { i };
                        for ky in 0..kernel {
                            for kx in 0..kernel {
                                let (py, px) = (
                                    (y * stride + ky).cast_signed() - before,
                                    (x * stride + kx).cast_signed() - before,
                                );
                                sum += f64::from(values[((o * of + i) * kernel + ky) * kernel + kx])
                                    * map.at(from, py, px);
                            }
                        }
                    }
                    let y = (sum - part("running_mean", o)) * scale + part("bias", o);
                    out.push(if rectify { y.clamp(0.0, 6.0) } else { y });
                }
            }
        }
        Map { n, side, values: out }
    }
}

#[test]
fn the_network_is_its_definition() {
    let numbers = made_up();
    let network = EfficientNet::new(&numbers).unwrap();
    let square = square(3);
    let [early, late] = network.features(&square, Depth::Both);
    assert_eq!((early.len(), late.len()), (N_EARLY, N_LATE));
    assert_eq!(network.features(&square, Depth::Early), [early.clone(), Vec::new()]);
    assert_eq!(network.features(&square, Depth::Late), [Vec::new(), late.clone()]);
    // In the order of the blocks.
    let mut got = early.into_iter().chain(late);
    let mut map = slow::Map {
        n: 3,
        side: SIDE,
        values: (0..3)
            .flat_map(|c| {
                square.rgb.iter().skip(c).step_by(3).map(|x| (255.0 * f64::from(*x) - 127.0) / 128.0)
            })
            .collect(),
    };
    map = slow::conv(&map, &numbers, "_conv_stem.weight", 2, "_bn0", true);
    let strides = [1, 2, 1, 2, 1, 2, 1, 1, 1, 1, 1, 2, 1, 1, 1, 1];
    for (index, stride) in strides.into_iter().enumerate() {
        let name = |part: &str| format!("_blocks.{index}.{part}");
        let wide = if index == 0 {
            slow::conv(&map, &numbers, &name("_depthwise_conv.weight"), stride, &name("_bn1"), true)
        } else {
            let wide = slow::conv(&map, &numbers, &name("_expand_conv.weight"), 1, &name("_bn0"), true);
            slow::conv(&wide, &numbers, &name("_depthwise_conv.weight"), stride, &name("_bn1"), true)
        };
        let mut next = slow::conv(&wide, &numbers, &name("_project_conv.weight"), 1, &name("_bn2"), false);
        if stride == 1 && next.n == map.n {
            next.values.iter_mut().zip(&map.values).for_each(|(y, x)| *y += x);
        }
        map = next;
        if [2, 4, 7, 10, 15].contains(&index) {
            let (means, deviations) = moments(&map);
            let expected: Vec<f64> = means.into_iter().chain(deviations).collect();
            let got: Vec<f32> = got.by_ref().take(expected.len()).collect();
            assert_eq!(got.len(), expected.len());
            for (got, expected) in got.into_iter().zip(expected) {
                // Single precision through up to sixteen blocks.
                assert!(
                    (f64::from(got) - expected).abs() < 1e-3 * (1.0 + expected.abs()),
                    "{got} {expected}"
                );
            }
        }
    }
    assert_eq!(got.next(), None);
}

/// Means and standard deviations of the channels.
fn moments(map: &slow::Map) -> (Vec<f64>, Vec<f64>) {
    let pixels = map.side * map.side;
    let of = |values: &[f64]| {
        let mean = values.iter().sum::<f64>() / pixels as f64;
        let deviation = (values.iter().map(|x| (x - mean).powi(2)).sum::<f64>() / (pixels - 1) as f64).sqrt();
        (mean, deviation)
    };
    map.values.chunks(pixels).map(of).unzip()
}

#[test]
fn a_file_is_told_by_its_names_and_checked() {
    let numbers = made_up();
    let bytes = file(&numbers);
    let backbone = Backbone::from_bytes(&bytes).unwrap();
    assert_eq!((backbone.kind().name(), backbone.sha256().len()), ("EfficientNet-Lite0", 64));
    let square = square(1);
    let [early, late] = EfficientNet::new(&numbers).unwrap().features(&square, Depth::Both);
    assert_eq!((early.len(), late.len()), (backbone.kind().n_features(), backbone.kind().n_late_features()));
    assert_eq!(backbone.features(&square).unwrap(), early);
    assert_eq!(backbone.late_features(&square).unwrap(), late);
    assert_eq!(backbone.early_and_late_features(&square).unwrap(), [early, late]);

    let failure = |change: &dyn Fn(&mut Numbers)| {
        let mut numbers = made_up();
        change(&mut numbers);
        Backbone::from_bytes(&file(&numbers)).unwrap_err()
    };
    let missing = failure(&|numbers| drop(numbers.remove("_blocks.3._bn1.bias")));
    assert!(matches!(missing, BackboneError::Missing { name } if name == "_blocks.3._bn1.bias"));
    let shape = failure(&|numbers| numbers.get_mut("_bn0.weight").unwrap().0 = vec![2, 16]);
    assert!(matches!(shape, BackboneError::Shape { .. }), "{shape}");
    let broken = failure(&|numbers| numbers.get_mut("_bn0.weight").unwrap().1[0] = f32::NAN);
    assert!(matches!(broken, BackboneError::Numbers { .. }), "{broken}");
    let unknown = failure(&|numbers| drop(numbers.remove("_conv_stem.weight")));
    assert!(matches!(unknown, BackboneError::Unknown), "{unknown}");
    assert!(matches!(Backbone::from_bytes(&bytes[..1000]), Err(BackboneError::Tensors(_))));
    assert!(
        matches!(Backbone::from_bytes(b"\x80\x02}q\x00."), Err(BackboneError::Tensors(_))),
        "a pickle must be refused"
    );
}
