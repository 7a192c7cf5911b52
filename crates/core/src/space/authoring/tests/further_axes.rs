//! Spaces with more axes than the canvas.

use proptest::prelude::{ProptestConfig, prop, prop_assert, proptest};

use super::{db, db_of, jump_at_worst, rms_difference, truth, world_of, world_on};
use crate::maths::rng::Random;
use crate::space::SpacePoint;
use crate::space::authoring::{Blending, Outside};
use crate::texture::TextureModel;
use crate::texture::blend::Mode;
use crate::texture::plane::Plane;

fn fields() -> [Blending; 3] {
    [
        Mode::Field.into(),
        Blending { outside: Outside::Extrapolated, ..Mode::Field.into() },
        Blending { locked: vec![0, 3, 4], ..Mode::Field.into() },
    ]
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(8))]

    /// The result is continuous along random ways through a cube of one to six dimensions: inside the convex hull, across
    /// it, and through textures, pinned ones as well.
    #[test]
    fn nothing_jumps_as_the_point_moves_on_any_number_of_axes(
        n_axes in 1_usize..7,
        seed in 0_u64..1000,
        ends in prop::collection::vec(prop::array::uniform6(0.0_f64..=100.0), 2),
    ) {
        let world = world_on(n_axes, 16, 2.0, seed);
        let [from, to] = [&ends[0], &ends[1]].map(|end| SpacePoint::of(&end[..n_axes]).unwrap());
        let (pinned, free) = (world.places[3], world.places[7]);
        for blending in fields() {
            let ways = [(from, to), (from, pinned), (pinned, free), (free, to)];
            let worst = ways.map(|(a, b)| jump_at_worst(&world, &blending, a, b)).into_iter().fold(0.0, f64::max);
            prop_assert!(worst < 0.02, "{} axes, {:?}: {} dB", n_axes, blending, worst);
        }
    }
}

/// The field follows every axis: its error on textures that differ along six axes is small, and larger where it knows only
/// two of them.
#[test]
fn the_field_follows_six_axes() {
    let on_six = world_on(6, 120, 0.0, 3);
    let textures: Vec<TextureModel> = on_six.places.iter().map(|at| truth(*at, 0.0)).collect();
    let on_two = world_of(on_six.places.iter().map(|at| at.on(2)).collect(), &textures);
    let field = Blending::from(Mode::Field);
    let mut random = Random::new(8);
    let errors_db = [(); 20].map(|()| {
        let coordinates: [f64; 6] = std::array::from_fn(|_| 30.0 + 40.0 * random.uniform());
        let at = SpacePoint::of(&coordinates).unwrap();
        let wanted = db_of(&[(&Plane::new(&truth(at, 0.0)), 1.0)], Mode::Shared);
        [(&on_six, at), (&on_two, at.on(2))].map(|(world, at)| {
            rms_difference(&db(world, &world.authoring.author(at, &field).unwrap()), &wanted)
        })
    });
    let sum = |of: usize| errors_db.iter().map(|errors| errors[of]).sum::<f64>();
    assert!(sum(0) < 0.3 * sum(1), "{} and {} dB over 20 points", sum(0), sum(1));
}
