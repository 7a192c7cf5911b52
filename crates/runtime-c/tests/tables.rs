//! Tables of starter textures: their texture is the exported one, and they fit a microcontroller.

#![allow(clippy::unwrap_used, clippy::print_stdout, reason = "tests")]

mod support;

use shagreen_formats::starter::starter_library;
use shagreen_runtime::texture::RuntimeTexture;
use support::Exported;

#[test]
fn every_starter_texture_comes_back_from_its_table() {
    let library = starter_library().unwrap();
    let (mut largest, mut most) = (0, 0);
    for entry in &library.textures {
        let entry = &library.with_terms(entry);
        let exported = Exported::of(entry);
        let texture = RuntimeTexture::load(&exported.table).unwrap();
        assert_eq!(texture.view().parts(), exported.prepared.parts(), "{}", entry.id);
        assert_eq!(texture.tap(), exported.tap);
        let texts = [texture.name(), texture.terms(), texture.origin()].map(|text| text.to_str().unwrap());
        assert_eq!(
            (texts, texture.is_restricted()),
            ([&entry.name, &entry.license, &entry.origin].map(String::as_str), false)
        );
        (largest, most) = (largest.max(exported.table.len()), most.max(texture.memory_bytes()));
    }
    println!("the largest table has {largest} bytes, the largest texture takes {most} bytes");
    assert!(largest < 1_000_000 && most < 1_000_000, "{largest} and {most} bytes");
}
