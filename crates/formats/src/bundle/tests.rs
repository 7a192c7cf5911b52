use std::io::{Cursor, Write as _};

use proptest::prelude::{any, proptest};
use zip::ZipWriter;
use zip::write::SimpleFileOptions;

use super::archive::pack;
use super::{
    Bundle, BundleError, BundleFile, BundleKind, BundleManifestV1, BundleRole, BundledFileV1,
    BundledTextureV1, MANIFEST, MAX_BYTES, OverrideV1, write_bundle,
};
use crate::layout;
use crate::project::sha256_hex;

fn manifest() -> BundleManifestV1 {
    let texture = BundledTextureV1 {
        id: "cork".to_owned(),
        name: "Cork".to_owned(),
        licence: "CC0-1.0".to_owned(),
        origin: "simulated".to_owned(),
        restricted: false,
        authored: false,
        parents: Vec::new(),
    };
    let statement = OverrideV1 { textures: vec!["Oak".to_owned()], statement: "Mine.".to_owned() };
    BundleManifestV1 {
        licence: "CC0-1.0".to_owned(),
        override_restriction: Some(statement),
        textures: vec![texture],
        ..BundleManifestV1::new("test", "Woods", BundleKind::Library)
    }
}

fn file(path: &str, bytes: &[u8]) -> BundleFile {
    BundleFile { path: path.to_owned(), role: BundleRole::Export, bytes: bytes.to_vec() }
}

fn bundle() -> Vec<u8> {
    let files = vec![file("exports/b.wav", &[7; 3000]), file("a.json", b"{\"a\": 1}"), file("empty", b"")];
    write_bundle(manifest(), files).unwrap()
}

/// An archive with this list, whatever it says about these files.
fn made_up(listed: &[(&str, &[u8])], packed: &[(&str, &[u8])]) -> Vec<u8> {
    let listed = listed.iter().map(|(path, bytes)| BundledFileV1 {
        path: (*path).to_owned(),
        role: BundleRole::Export,
        bytes: bytes.len() as u64,
        sha256: sha256_hex(bytes),
    });
    with_list(&BundleManifestV1 { files: listed.collect(), ..manifest() }, packed)
}

fn with_list(manifest: &BundleManifestV1, packed: &[(&str, &[u8])]) -> Vec<u8> {
    let list = layout::to_bytes(manifest, 2);
    pack([(MANIFEST, &list[..])].into_iter().chain(packed.iter().copied()), true).unwrap()
}

/// The error of opening and checking a bundle.
#[track_caller]
fn refused(bytes: &[u8]) -> String {
    let checked = Bundle::open(bytes).and_then(|mut bundle| bundle.check());
    checked.expect_err("this bundle is refused").to_string()
}

#[test]
fn a_bundle_comes_back_and_is_the_same_each_time() {
    let bytes = bundle();
    assert_eq!(bytes, bundle());
    let mut opened = Bundle::open(&bytes).unwrap();
    opened.check().unwrap();
    let paths: Vec<&str> = opened.manifest().files.iter().map(|file| file.path.as_str()).collect();
    assert_eq!(paths, ["a.json", "empty", "exports/b.wav"]);
    assert_eq!(BundleManifestV1 { files: Vec::new(), ..opened.manifest().clone() }, manifest());
    assert_eq!(opened.file(0).unwrap(), b"{\"a\": 1}");
    assert_eq!(opened.file(1).unwrap(), b"");
    assert_eq!(opened.file(2).unwrap(), [7; 3000]);
    assert!(opened.file(3).is_err());
    // Other programs read it too: it begins and ends as every ZIP archive.
    assert!(bytes.starts_with(b"PK\x03\x04") && bytes[bytes.len() - 22..].starts_with(b"PK\x05\x06"));
}

#[test]
fn silence_is_no_size_bomb() {
    let silence = vec![0; 20 << 20];
    let bytes = write_bundle(manifest(), vec![file("silence.wav", &silence)]).unwrap();
    Bundle::open(&bytes).unwrap().check().unwrap();
}

#[test]
fn paths_that_lead_out_of_the_folder_are_refused() {
    for path in
        ["../up.json", "/etc/cron.d/x", "C:/x", "a\\..\\..\\x", "a/../../x", "nul", MANIFEST, "Bundle.JSON"]
    {
        let error = refused(&made_up(&[(path, b"x")], &[(if path == MANIFEST { "y" } else { path }, b"x")]));
        assert!(error.contains("cannot be in a bundle"), "{path}: {error}");
        assert!(matches!(write_bundle(manifest(), vec![file(path, b"x")]), Err(BundleError::Path { .. })));
    }
    for [a, b] in [["a.json", "A.json"], ["a", "a/b"], ["x/y", "X"]] {
        let error = refused(&made_up(&[(a, b"x"), (b, b"y")], &[(a, b"x"), (b, b"y")]));
        assert!(error.contains("is that of a"), "{a} {b}: {error}");
    }
}

#[test]
fn only_what_is_listed_is_in_a_bundle() {
    assert!(refused(&made_up(&[("a", b"x")], &[])).contains("\"a\" of the bundle is missing"));
    assert!(refused(&made_up(&[("a", b"x")], &[("a", b"x"), ("b", b"y")])).contains("not in its list"));
    assert!(refused(&made_up(&[("a", b"x")], &[("a", b"y")])).contains("was changed"));
    assert!(refused(&made_up(&[("a", b"x")], &[("a", b"")])).contains("was changed"));
    assert!(refused(&made_up(&[("a", b"x")], &[("a", b"xy")])).contains("more than 1 bytes"));
}

#[test]
fn sizes_that_no_bundle_has_are_refused_before_anything_is_decompressed() {
    let listed = |bytes| BundledFileV1 {
        path: "a".to_owned(),
        role: BundleRole::Export,
        bytes,
        sha256: sha256_hex(b""),
    };
    for bytes in [1 << 30, MAX_BYTES + 1, u64::MAX] {
        let large = BundleManifestV1 { files: vec![listed(bytes)], ..manifest() };
        let error = Bundle::open(&with_list(&large, &[("a", b"")])).map(drop).unwrap_err();
        assert!(matches!(error, BundleError::TooLarge { .. }), "{error}");
    }
    let long = BundleManifestV1 { name: " ".repeat(8 << 20), ..manifest() };
    assert!(refused(&with_list(&long, &[])).contains("\"bundle.json\" of the bundle has more than"));
    // A file that is longer than its list says is not read.
    let bomb = vec![0; 8 << 20];
    assert!(refused(&made_up(&[("a", b"x")], &[("a", &bomb)])).contains("more than 1 bytes"));
}

#[test]
fn links_are_refused() {
    let list = layout::to_bytes(
        &BundleManifestV1 {
            files: vec![BundledFileV1 {
                path: "a".to_owned(),
                role: BundleRole::Export,
                bytes: 11,
                sha256: sha256_hex(b"/etc/passwd"),
            }],
            ..manifest()
        },
        2,
    );
    let mut writer = ZipWriter::new(Cursor::new(Vec::new()));
    let options = SimpleFileOptions::default();
    writer.start_file(MANIFEST, options).unwrap();
    writer.write_all(&list).unwrap();
    writer.add_symlink("a", "/etc/passwd", options).unwrap();
    let bytes = writer.finish().unwrap().into_inner();
    assert!(refused(&bytes).contains("is a link or a folder"));
}

#[test]
fn other_files_say_what_they_are() {
    assert!(refused(b"").contains("the file is empty"));
    assert!(refused(b"{\"format\": \"shagreen-project\"}").contains("not a bundle"));
    let office = pack([("word.xml", &b"<a/>"[..])].into_iter(), true).unwrap();
    assert!(refused(&office).contains("does not begin with bundle.json"));
    let other = pack([(MANIFEST, &b"{\"format\": \"x\"}"[..])].into_iter(), true).unwrap();
    assert!(refused(&other).contains("not a bundle"));
    let bytes = bundle();
    for end in [4, 21, bytes.len() / 2, bytes.len() - 1] {
        assert!(refused(&bytes[..end]).contains("damaged"), "{end}");
    }
    let text = String::from_utf8(layout::to_bytes(&manifest(), 2)).unwrap();
    for (list, words) in [
        (text.replace("\"1.0\"", "\"2.0\""), "version 2.0"),
        (text.replace("\"library\"", "\"game\""), "damaged"),
        (text[..text.len() / 2].to_owned(), "damaged"),
    ] {
        let bytes = pack([(MANIFEST, list.as_bytes())].into_iter(), true).unwrap();
        assert!(refused(&bytes).contains(words), "{words}: {}", refused(&bytes));
    }
}

/// The record at the end states how much memory the list of the archive needs.
#[test]
fn an_end_that_states_more_than_there_is_is_refused() {
    let bytes = bundle();
    let at = bytes.len() - 22;
    for (offset, value) in
        [(8, [0xff; 2]), (10, [0xff; 2]), (12, [0xff; 2]), (16, [0xff; 2]), (20, [1, 0]), (4, [1, 0])]
    {
        let mut changed = bytes.clone();
        changed[at + offset..at + offset + 2].copy_from_slice(&value);
        assert!(refused(&changed).contains("no end as a bundle has it"), "{offset}");
    }
}

proptest! {
    #[test]
    fn no_bytes_panic(bytes in proptest::collection::vec(any::<u8>(), 0..300)) {
        let _ = Bundle::open(&bytes).map(|mut bundle| bundle.check());
        let beginning = [&b"PK\x03\x04"[..], &bytes].concat();
        let _ = Bundle::open(&beginning).map(|mut bundle| bundle.check());
    }

    /// A changed byte is found, or changes nothing that a bundle says.
    #[test]
    fn a_changed_byte_never_passes_as_another_bundle(at in any::<proptest::sample::Index>(), bit in 0..8_u32) {
        let bytes = bundle();
        let mut changed = bytes.clone();
        changed[at.index(bytes.len())] ^= 1 << bit;
        if let Ok(mut opened) = Bundle::open(&changed) && opened.check().is_ok() {
            let mut original = Bundle::open(&bytes).unwrap();
            assert_eq!(opened.manifest(), original.manifest());
            for index in 0..3 {
                assert_eq!(opened.file(index), original.file(index));
            }
        }
    }
}
