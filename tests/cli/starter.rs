//! The committed starter library: it is made from the committed materials, and its statistics are those of real
//! surfaces.

use shagreen_core::dsp::spectrum::centroid;
use shagreen_core::surfaces::starter;
use shagreen_core::texture::TextureModel;
use shagreen_core::texture::plane::Plane;
use shagreen_core::units::{Contact, Hertz};
use shagreen_formats::library::Library;
use shagreen_formats::materials_toml::read_materials;
use shagreen_formats::starter::{starter_bytes, starter_library};

const MATERIALS: &[u8] = include_bytes!("../../assets/starter/materials.toml");

fn library() -> Library {
    starter_library().unwrap()
}

#[test]
fn it_fits_into_three_megabytes() {
    assert!(starter_bytes().len() <= 3_000_000, "{}", starter_bytes().len());
}

#[test]
fn it_has_every_material_in_order() {
    let materials = read_materials(MATERIALS).unwrap();
    let ids: Vec<String> = library().textures.iter().map(|texture| texture.id.clone()).collect();
    assert_eq!(ids, materials.materials.iter().map(|material| material.id.clone()).collect::<Vec<_>>());
    assert_eq!(library().seed, Some(materials.seed));
}

/// A texture remade from the TOML file is the committed one. After a change of a material, make the library again
/// (`shagreen library make assets/starter/materials.toml --out assets/starter/starter.json --licence "…"`).
#[test]
fn a_material_made_again_is_the_committed_texture() {
    let materials = read_materials(MATERIALS).unwrap();
    let material = materials.materials.iter().find(|material| material.id == "cork").unwrap();
    let made = starter::make(material, materials.seed).unwrap();
    let library = library();
    let committed = &library.textures[library.index_of("cork").unwrap()];
    assert_eq!(made.model.order(), committed.model.order());
    assert_eq!(made.model.friction(), committed.model.friction());
    for (made, committed) in made.model.nodes().iter().zip(committed.model.nodes()) {
        assert!((made.speed.0 - committed.speed.0).abs() < 1e-9 && made.force == committed.force);
        // The file has six digits and six decimals. Another platform's sine may differ in its last bit, which a chaotic
        // bounce can amplify.
        assert!((made.level_mps2 / committed.level_mps2 - 1.0).abs() < 1e-3);
        for (made, committed) in made.lsf.iter().zip(&committed.lsf) {
            assert!((made - committed).abs() < 1e-3, "{made} for {committed}");
        }
    }
    let labels = committed.physical.unwrap();
    assert!((made.labels.roughness_log10_mps2 - labels.roughness_log10_mps2).abs() < 1e-3);
    assert!((made.labels.hardness_log10_n_per_m - labels.hardness_log10_n_per_m).abs() < 1e-5);
}

#[test]
fn positions_are_the_labels_spread_over_the_axes() {
    let library = library();
    let labels: Vec<starter::Labels> = library
        .textures
        .iter()
        .map(|texture| {
            let physical = texture.physical.unwrap();
            starter::Labels {
                roughness_log10_mps2: physical.roughness_log10_mps2,
                hardness_log10_n_per_m: physical.hardness_log10_n_per_m,
            }
        })
        .collect();
    for (texture, place) in library.textures.iter().zip(starter::places(&labels)) {
        assert!(texture.at().unwrap().distance(place) < 0.01, "{}", texture.id);
    }
}

/// Fits `ln level = c + α ln speed + β ln force` by least squares over the nodes and returns (α, β).
fn exponents(model: &TextureModel) -> (f64, f64) {
    let rows: Vec<[f64; 3]> =
        model.nodes().iter().map(|n| [n.speed.0.ln(), n.force.0.ln(), n.level_mps2.ln()]).collect();
    let n = rows.len() as f64;
    let mean = |k: usize| rows.iter().map(|row| row[k]).sum::<f64>() / n;
    let (mv, mf, ml) = (mean(0), mean(1), mean(2));
    let product = |a: usize, b: usize| {
        let m = [mv, mf, ml];
        rows.iter().map(|row| (row[a] - m[a]) * (row[b] - m[b])).sum::<f64>()
    };
    let (vv, ff, vf, vl, fl) = (product(0, 0), product(1, 1), product(0, 1), product(0, 2), product(1, 2));
    let determinant = vv * ff - vf * vf;
    ((vl * ff - fl * vf) / determinant, (fl * vv - vl * vf) / determinant)
}

#[track_caller]
fn check_range(what: &str, id: &str, value: f64, low: f64, high: f64) {
    assert!((low..=high).contains(&value), "{what} of {id} is {value}, real surfaces have {low} to {high}");
}

fn median(mut values: Vec<f64>) -> f64 {
    values.sort_by(f64::total_cmp);
    values[values.len() / 2]
}

/// Ranges over 100 measured surfaces (aggregates only): level and spectral centroid at 100 mm/s and 1 N, and the
/// exponents of the level in speed and force.
#[test]
fn its_statistics_lie_within_those_of_real_surfaces() {
    let contact = Contact::from_mm_per_s_and_n(100.0, 1.0);
    let frequencies: Vec<Hertz> = (0..=490).map(|i| Hertz(10.0 + f64::from(i))).collect();
    let (mut alphas, mut betas) = (Vec::new(), Vec::new());
    for texture in &library().textures {
        let grain = Plane::new(&texture.model).at(contact);
        let density: Vec<(Hertz, f64)> = frequencies.iter().copied().zip(grain.psd(&frequencies)).collect();
        let centroid_hz = centroid(&density, Hertz(10.0), Hertz(500.0)).0;
        let (alpha, beta) = exponents(&texture.model);
        println!(
            "{:22} {:6.2} m/s² {centroid_hz:6.1} Hz α {alpha:.2} β {beta:.2}",
            texture.id, grain.level_mps2
        );
        check_range("level", &texture.id, grain.level_mps2, 0.16, 10.6);
        check_range("centroid", &texture.id, centroid_hz, 45.0, 311.0);
        check_range("growth with speed", &texture.id, alpha, 0.45, 1.5);
        check_range("growth with force", &texture.id, beta, 0.08, 0.6);
        alphas.push(alpha);
        betas.push(beta);
    }
    check_range("median growth with speed", "all", median(alphas), 0.8, 1.15);
    check_range("median growth with force", "all", median(betas), 0.2, 0.36);
}
