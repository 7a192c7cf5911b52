//! Addresses of files beside a scene, and other addresses.

/// Returns the address of a file: bytes other than letters, digits and `-._~` are written as `%` and two hexadecimal digits.
pub(crate) fn uri_of(name: &str) -> String {
    let encoded = |byte: u8| {
        if byte.is_ascii_alphanumeric() || b"-._~".contains(&byte) {
            char::from(byte).to_string()
        } else {
            format!("%{byte:02X}")
        }
    };
    name.bytes().map(encoded).collect()
}

/// Returns the name of the file at an address; `None` if a `%` is not followed by two hexadecimal digits, or if the bytes are
/// not UTF-8.
pub(crate) fn name_of(uri: &str) -> Option<String> {
    let mut bytes = Vec::with_capacity(uri.len());
    let mut rest = uri.bytes();
    while let Some(byte) = rest.next() {
        bytes.push(if byte == b'%' {
            16 * hexadecimal(rest.next()?)? + hexadecimal(rest.next()?)?
        } else {
            byte
        });
    }
    String::from_utf8(bytes).ok() // Other bytes are no name.
}

fn hexadecimal(digit: u8) -> Option<u8> {
    let value = char::from(digit).to_digit(16)?;
    u8::try_from(value).ok() // A digit is below 16.
}

#[cfg(test)]
mod tests {
    use super::{name_of, uri_of};
    use proptest::prelude::{prop_assert, prop_assert_eq, proptest};

    #[test]
    fn names_are_encoded_as_addresses() {
        assert_eq!(uri_of("my oak.bin"), "my%20oak.bin");
        assert_eq!(uri_of("Größe#1.png"), "Gr%C3%B6%C3%9Fe%231.png");
        assert_eq!(name_of("a%2fb.png").as_deref(), Some("a/b.png"));
        for damaged in ["%", "%4", "%zz", "%ff"] {
            assert_eq!(name_of(damaged), None, "{damaged}");
        }
    }

    proptest! {
        #[test]
        fn names_come_back(name in "\\PC{0,12}") {
            let uri = uri_of(&name);
            prop_assert!(uri.is_ascii());
            prop_assert_eq!(name_of(&uri), Some(name));
        }
    }
}
