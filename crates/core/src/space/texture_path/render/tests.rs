use super::{PathPlan, render_path};
use crate::dsp::ar::test_signals::from_resonances;
use crate::dsp::lsf::lsf_from_ar;
use crate::space::SpacePoint;
use crate::space::texture_path::{Along, AtEnd, Key, Stop, TexturePath};
use crate::texture::plane::{Plane, Prepared};
use crate::texture::render::RenderError;
use crate::texture::{GrainNode, TextureModel};
use crate::units::{Contact, Hertz, MetersPerSecond, Newtons};

/// A path between two textures with levels 1 and 4: the level follows the distance that the tip has traveled since
/// contact.
#[test]
fn a_path_is_heard_as_it_is_traveled() {
    let model = |level: f64| {
        let nodes = [0.05, 0.2].into_iter().flat_map(|v| {
            [0.5, 1.0].map(|f| GrainNode {
                speed: MetersPerSecond(v),
                force: Newtons(f),
                lsf: lsf_from_ar(&from_resonances(Hertz(1000.0), &[(Hertz(120.0), 0.8)])).unwrap(),
                level_mps2: level,
            })
        });
        TextureModel::new(Hertz(1000.0), nodes.collect(), None).unwrap()
    };
    let key = |level: f64, along: f64| Key {
        stop: Stop { at: SpacePoint::plane(0.0, 0.0), along },
        is_stop: true,
        model: model(level),
    };
    let path = TexturePath::new(Along::Distance, AtEnd::Hold, vec![key(1.0, 0.0), key(4.0, 0.4)]).unwrap();
    let prepared: Vec<Prepared> = path.keys().iter().map(|key| Plane::new(&key.model).prepare()).collect();
    for rate in [1000.0, 8000.0] {
        // 0.1 m/s for two seconds, two seconds lifted, five more seconds.
        let plan = PathPlan { path: &path, prepared: &prepared, rate: Hertz(rate), seconds: 9.0, seed: 3 };
        let mut contact_at = |t: f64| {
            let is_lifted = (2.0..4.0).contains(&t);
            Contact::from_mm_per_s_and_n(100.0, if is_lifted { 0.0 } else { 0.7 })
        };
        let x = render_path(&plan, &mut contact_at).unwrap();
        let level = |from: f64, to: f64| {
            let part = &x[(from * rate) as usize..(to * rate) as usize];
            (part.iter().map(|v| f64::from(*v).powi(2)).sum::<f64>() / part.len() as f64).sqrt()
        };
        // With one excitation, levels of equal spectra add up, so the level is linear along the path.
        for (from, to, want) in
            [(0.9, 1.1, 1.75), (1.9, 2.0, 2.46), (4.1, 4.3, 1.15), (5.9, 6.1, 2.5), (8.1, 8.9, 4.0)]
        {
            let got = level(from, to);
            assert!((got / want - 1.0).abs() < 0.25, "{rate}: {got} for {want} from {from}");
        }
        assert!(level(2.5, 3.9) < 1e-3);
    }
    let few = PathPlan { path: &path, prepared: &prepared[..1], rate: Hertz(1000.0), seconds: 1.0, seed: 3 };
    assert_eq!(
        render_path(&few, &mut |_: f64| Contact::from_mm_per_s_and_n(80.0, 0.7)),
        Err(RenderError::Keys { n: 1, keys: 2 })
    );
}
