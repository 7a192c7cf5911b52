//! What may have been meant by the name of no texture.

use shagreen_formats::library::Library;

/// That there is no such texture, and which have a name like it.
pub(crate) fn unknown_texture(library: &Library, id: &str) -> String {
    format!("the library has no texture \"{id}\"; {}", meant(library, id))
}

/// Which textures may have been meant by what is the name of none.
pub(crate) fn meant(library: &Library, id: &str) -> String {
    let near = near_ids(library, id);
    if near.is_empty() {
        "`shagreen library list` shows what there is".to_owned()
    } else {
        format!("did you mean {}?", near.join(", "))
    }
}

/// Up to three identifiers like `id`, the nearest first.
fn near_ids<'a>(library: &'a Library, id: &str) -> Vec<&'a str> {
    let wanted = id.to_lowercase();
    let mut near: Vec<(usize, &str)> = library
        .textures
        .iter()
        .filter_map(|texture| {
            let distance = edits(&wanted, &texture.id.to_lowercase());
            let is_part = wanted.len() > 2 && texture.id.contains(&wanted);
            let is_near = distance <= 1 + wanted.chars().count() / 3;
            (is_part || is_near).then_some((if is_part { 0 } else { distance }, texture.id.as_str()))
        })
        .collect();
    near.sort_unstable();
    near.into_iter().take(3).map(|(_, id)| id).collect()
}

/// Letters to insert, delete or replace to make one word of the other (Levenshtein).
fn edits(a: &str, b: &str) -> usize {
    let b: Vec<char> = b.chars().collect();
    let mut row: Vec<usize> = (0..=b.len()).collect();
    for (i, from) in a.chars().enumerate() {
        let mut diagonal = row[0];
        row[0] = i + 1;
        for (j, to) in b.iter().enumerate() {
            let replaced = diagonal + usize::from(from != *to);
            diagonal = row[j + 1];
            row[j + 1] = replaced.min(diagonal + 1).min(row[j] + 1);
        }
    }
    row[b.len()]
}

#[cfg(test)]
mod tests {
    use super::edits;

    #[test]
    fn edits_are_counted() {
        for (a, b, n) in
            [("", "", 0), ("cork", "cork", 0), ("crok", "cork", 2), ("", "abc", 3), ("kitten", "sitting", 3)]
        {
            assert_eq!((edits(a, b), edits(b, a)), (n, n), "{a} {b}");
        }
    }
}
