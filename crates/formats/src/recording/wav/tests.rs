use super::read_wav;

/// The format chunk of one channel at 8000 Hz; `valid_bits` selects the extensible form.
fn format(tag: u16, bytes_a_sample: u16, valid_bits: Option<u16>) -> Vec<u8> {
    let mut body = Vec::new();
    body.extend(if valid_bits.is_some() { 0xFFFE } else { tag }.to_le_bytes());
    body.extend(1_u16.to_le_bytes());
    body.extend(8000_u32.to_le_bytes());
    body.extend((8000 * u32::from(bytes_a_sample)).to_le_bytes());
    body.extend(bytes_a_sample.to_le_bytes());
    body.extend((8 * bytes_a_sample).to_le_bytes());
    if let Some(bits) = valid_bits {
        body.extend(22_u16.to_le_bytes());
        body.extend(bits.to_le_bytes());
        body.extend(4_u32.to_le_bytes());
        body.extend(tag.to_le_bytes());
        body.extend(b"\0\0\0\0\x10\0\x80\0\0\xaa\0\x38\x9b\x71");
    }
    body
}

fn chunk(name: &str, stated: u32, body: &[u8]) -> Vec<u8> {
    [name.as_bytes(), &stated.to_le_bytes(), body].concat()
}

/// A file whose header and data chunk state these sizes.
fn file(kind: &str, sizes: [u32; 2], chunks: &[Vec<u8>], data: &[u8]) -> Vec<u8> {
    let head = [chunk(kind, sizes[0], b"WAVE"), chunks.concat()].concat();
    [head, chunk("data", sizes[1], data)].concat()
}

/// Checks the samples of one channel, and whether a warning contains `words`.
#[track_caller]
fn check(bytes: &[u8], expected: &[f64], words: Option<&str>) {
    let samples = read_wav(bytes).unwrap();
    assert_eq!(samples.channels, [expected.to_vec()]);
    match words {
        None => assert!(samples.warnings.is_empty(), "{:?}", samples.warnings),
        Some(words) => {
            assert!(samples.warnings.iter().any(|one| one.contains(words)), "{:?}", samples.warnings);
        }
    }
}

/// 0.5 and -1, in 16 bits.
const DATA: [u8; 4] = [0, 0x40, 0, 0x80];

#[test]
fn extensible_formats_are_what_their_subformat_says() {
    let extensible = |tag: u16, bytes: u16, valid: u16| chunk("fmt ", 40, &format(tag, bytes, Some(valid)));
    let read = |format: Vec<u8>, data: &[u8], expected: &[f64]| {
        let size = data.len() as u32;
        check(&file("RIFF", [52 + size, size], &[format], data), expected, None);
    };
    // 24 valid bits are the upper ones of 32, so full scale is that of 32 bits.
    read(extensible(1, 4, 24), &[0, 0, 0, 0x40, 0, 0, 0, 0x80, 0, 1, 0, 0], &[0.5, -1.0, 2.0_f64.powi(-23)]);
    read(extensible(1, 2, 12), &DATA, &[0.5, -1.0]);
    read(extensible(1, 3, 20), &[0, 0, 0x40, 0, 0, 0x80], &[0.5, -1.0]);
    read(extensible(3, 4, 32), &0.5_f32.to_le_bytes(), &[0.5]);
    read(extensible(3, 8, 64), &1.5_f64.to_le_bytes(), &[1.5]);
    let size = DATA.len() as u32;
    let short = chunk("fmt ", 18, &format(1, 4, Some(24))[..18]);
    assert!(read_wav(&file("RIFF", [30 + size, size], &[short], &DATA)).is_err());
    let compressed = extensible(0x55, 4, 32);
    let error = read_wav(&file("RIFF", [52 + size, size], &[compressed], &DATA)).unwrap_err().to_string();
    assert!(error.contains("compressed (format 85)"), "{error}");
}

#[test]
fn files_of_64_bit_sizes_end_where_they_say() {
    let plain = chunk("fmt ", 16, &format(1, 2, None));
    let sizes = |data: u64| {
        let body = [100_u64.to_le_bytes(), data.to_le_bytes(), 2_u64.to_le_bytes()].concat();
        chunk("ds64", 28, &[body, vec![0; 4]].concat())
    };
    for kind in ["RF64", "BW64"] {
        let mut bytes = file(kind, [u32::MAX; 2], &[sizes(4), plain.clone()], &DATA);
        check(&bytes, &[0.5, -1.0], None);
        // Bytes after the data chunk are not samples.
        bytes.extend(chunk("junk", 4, b"abcd"));
        check(&bytes, &[0.5, -1.0], None);
        check(
            &file(kind, [u32::MAX; 2], &[sizes(400), plain.clone()], &DATA),
            &[0.5, -1.0],
            Some("truncated"),
        );
        check(
            &file(kind, [u32::MAX; 2], &[sizes(u64::MAX), plain.clone()], &DATA),
            &[0.5, -1.0],
            Some("truncated"),
        );
        // If the 64-bit sizes are missing or were never filled in, the file is read to its end.
        check(
            &file(kind, [u32::MAX; 2], std::slice::from_ref(&plain), &DATA),
            &[0.5, -1.0],
            Some("to its end"),
        );
        check(
            &file(kind, [u32::MAX; 2], &[sizes(0), plain.clone()], &DATA),
            &[0.5, -1.0],
            Some("to its end"),
        );
    }
}

#[test]
fn sizes_that_were_never_filled_in_are_those_of_the_file() {
    let plain = [chunk("fmt ", 16, &format(1, 2, None))];
    for sizes in [[0, 0], [u32::MAX, u32::MAX], [u32::MAX, 0], [0, u32::MAX], [40, u32::MAX]] {
        check(&file("RIFF", sizes, &plain, &DATA), &[0.5, -1.0], Some("to its end"));
        // A partial sample at the end is ignored.
        check(&file("RIFF", sizes, &plain, &DATA[..3]), &[0.5], Some("to its end"));
    }
    // A file that states its size and an empty data chunk has no samples.
    let bytes = file("RIFF", [40, 0], &plain, &DATA);
    assert!(read_wav(&bytes).unwrap_err().to_string().contains("no samples"));
    check(&file("RIFF", [0, 4], &plain, &DATA), &[0.5, -1.0], None);
}
