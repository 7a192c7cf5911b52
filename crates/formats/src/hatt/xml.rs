//! Elements and numbers of an XML document, however they are nested: bounded before and while it is parsed.

use std::borrow::Cow;

use roxmltree::{Document, Node, ParsingOptions};

use crate::hatt::HattError;

/// Longest file, in bytes: files of the published toolkit have some hundred thousand.
const MAX_BYTES: usize = 64 << 20;
/// Most elements and texts, and most attributes, at about a hundred bytes each while the file is read. Published files
/// have some ten thousand.
const MAX_NODES: u32 = 300_000;
/// Most attributes of one element: comparing all with all, as a parser must, stays cheap.
const MAX_ATTRIBUTES: usize = 64;

/// The text of a file and whether it had to be taken for Latin-1.
pub(super) fn decode(bytes: &[u8]) -> Result<(Cow<'_, str>, bool), HattError> {
    let refused = |reason: &str| Err(HattError::Xml { reason: reason.to_owned() });
    if bytes.len() > MAX_BYTES {
        return refused("it is longer than 64 MiB");
    }
    if bytes.starts_with(&[0xFE, 0xFF]) || bytes.starts_with(&[0xFF, 0xFE]) {
        return refused("it is encoded as UTF-16; save it as UTF-8");
    }
    let bytes = bytes.strip_prefix(b"\xEF\xBB\xBF").unwrap_or(bytes);
    match std::str::from_utf8(bytes) {
        Ok(text) => Ok((Cow::Borrowed(text), false)),
        // Every byte is a letter there; it concerns names only, for numbers are ASCII.
        Err(_) => Ok((Cow::Owned(bytes.iter().copied().map(char::from).collect()), true)),
    }
}

/// The document of a text.
pub(super) fn parse(text: &str) -> Result<Document<'_>, HattError> {
    let refused = |reason: String| HattError::Xml { reason };
    let has_crowd = |part: &str| part.bytes().filter(|byte| *byte == b'=').count() > MAX_ATTRIBUTES;
    if text.split('<').any(has_crowd) {
        return Err(refused(format!("an element has more than {MAX_ATTRIBUTES} attributes")));
    }
    if text.bytes().filter(|byte| *byte == b'=').count() > MAX_NODES as usize {
        return Err(refused(format!("it has more than {MAX_NODES} attributes")));
    }
    let options = ParsingOptions { allow_dtd: false, nodes_limit: MAX_NODES, ..ParsingOptions::default() };
    Document::parse_with_options(text.trim_start(), options).map_err(|error| match error {
        roxmltree::Error::DtdDetected => refused(
            "it declares a document type, which could pull in other files; remove the <!DOCTYPE …>".into(),
        ),
        roxmltree::Error::NodesLimitReached => refused(format!("it has more than {MAX_NODES} elements")),
        error => refused(error.to_string()),
    })
}

/// Whether an element has this name; letter case and name spaces do not count.
pub(super) fn is_named(node: Node<'_, '_>, name: &str) -> bool {
    node.is_element() && node.tag_name().name().eq_ignore_ascii_case(name)
}

/// What stands for `name` in `parent`: elements of that name at any depth, but not inside an element `except`.
pub(super) fn named<'a, 'i>(parent: Node<'a, 'i>, name: &str, except: &str) -> Vec<Node<'a, 'i>> {
    let mut found = Vec::new();
    let mut next = parent.first_child();
    while let Some(node) = next {
        let skip = is_named(node, name) || is_named(node, except);
        if is_named(node, name) {
            found.push(node);
        }
        next = if skip { None } else { node.first_child() }.or_else(|| following(node, parent));
    }
    found
}

/// The next node outside `node` and inside `within`, in the order of the document.
fn following<'a, 'i>(node: Node<'a, 'i>, within: Node<'a, 'i>) -> Option<Node<'a, 'i>> {
    node.ancestors().take_while(|ancestor| *ancestor != within).find_map(|ancestor| ancestor.next_sibling())
}

/// All words of an element in the order of the document: those of its texts, and of attributes `value` inside it. Where
/// there are none, those of all its attributes. Words are parted by white space, commas and semicolons, and may stand in
/// brackets.
pub(super) fn words<'a>(node: Node<'a, '_>) -> Vec<&'a str> {
    let mut texts: Vec<&'a str> = Vec::new();
    for inner in node.descendants() {
        if inner.is_text() {
            texts.extend(inner.text());
        } else if inner.is_element() {
            texts.extend(
                inner.attributes().find(|a| a.name().eq_ignore_ascii_case("value")).map(|a| a.value()),
            );
        }
    }
    let split = |texts: &[&'a str]| -> Vec<&'a str> {
        let is_between = |c: char| c.is_whitespace() || matches!(c, ',' | ';' | '[' | ']');
        texts.iter().flat_map(|text| text.split(is_between)).filter(|word| !word.is_empty()).collect()
    };
    let found = split(&texts);
    if !found.is_empty() {
        return found;
    }
    let attributes: Vec<&'a str> = node.attributes().map(|attribute| attribute.value()).collect();
    split(&attributes)
}

/// The numbers of an element, see [`words`].
pub(super) fn numbers(node: Node<'_, '_>) -> Result<Vec<f64>, HattError> {
    words(node).into_iter().map(|word| number(word, node)).collect()
}

/// A finite number that stands in `node`.
pub(super) fn number(word: &str, node: Node<'_, '_>) -> Result<f64, HattError> {
    word.parse().ok().filter(|value: &f64| value.is_finite()).ok_or_else(|| HattError::Number {
        element: node.tag_name().name().to_owned(),
        line: line_of(node),
        found: word.chars().take(40).collect(),
    })
}

/// The line of a node, from one. Costs a look through the file: for errors only.
pub(super) fn line_of(node: Node<'_, '_>) -> u32 {
    node.document().text_pos_at(node.range().start).row
}

/// The text of a single element, trimmed; `None` where it is missing or empty.
pub(super) fn text<'a>(parent: Node<'a, '_>, name: &str, except: &str) -> Option<&'a str> {
    let of_element = |node: Node<'a, '_>| {
        let attribute = node.attributes().find(|a| a.name().eq_ignore_ascii_case("value")).map(|a| a.value());
        let inside = node.descendants().filter(Node::is_text).filter_map(|n| n.text());
        inside.chain(attribute).map(str::trim).find(|text| !text.is_empty())
    };
    let attribute = || {
        let attribute = parent.attributes().find(|a| a.name().eq_ignore_ascii_case(name))?;
        Some(attribute.value().trim()).filter(|text| !text.is_empty())
    };
    named(parent, name, except).first().copied().and_then(of_element).or_else(attribute)
}

/// A single number, as an element or as an attribute of `parent`; `None` where it is missing.
pub(super) fn scalar(parent: Node<'_, '_>, name: &str, except: &str) -> Result<Option<f64>, HattError> {
    match named(parent, name, except).first() {
        Some(node) => match numbers(*node)?[..] {
            [] => Ok(None),
            [value] => Ok(Some(value)),
            ref values => Err(HattError::Count {
                element: name.to_owned(),
                line: line_of(*node),
                found: values.len(),
                expected: 1,
            }),
        },
        None => parent
            .attributes()
            .find(|attribute| attribute.name().eq_ignore_ascii_case(name))
            .map(|attribute| number(attribute.value().trim(), parent))
            .transpose(),
    }
}

/// The numbers of all elements `name`, one after the other; as an attribute of `parent` where there is no element.
pub(super) fn list(parent: Node<'_, '_>, name: &str, except: &str) -> Result<Vec<f64>, HattError> {
    let nodes = named(parent, name, except);
    let mut values = Vec::new();
    for node in &nodes {
        values.extend(numbers(*node)?);
    }
    if nodes.is_empty()
        && let Some(attribute) = parent.attributes().find(|a| a.name().eq_ignore_ascii_case(name))
    {
        for word in attribute.value().split(|c: char| c.is_whitespace() || c == ',' || c == ';') {
            if !word.is_empty() {
                values.push(number(word, parent)?);
            }
        }
    }
    Ok(values)
}
