//! Elements and numbers of an XML document at any nesting, with size limits before and during parsing.

use std::borrow::Cow;

use roxmltree::{Document, Node, ParsingOptions};

use crate::hatt::HattError;

/// Maximum file size in bytes; files of the published toolkit have some hundred thousand.
const MAX_BYTES: usize = 64 << 20;
/// Maximum number of elements and texts, and of attributes; each takes about a hundred bytes while parsing. Published
/// files have some ten thousand.
const MAX_NODES: u32 = 300_000;
/// Maximum number of attributes of one element, because the parser compares all pairs.
const MAX_ATTRIBUTES: usize = 64;

/// Decodes a file; returns its text and whether it was read as Latin-1.
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
        // Every byte is a Latin-1 character. This only affects names, because numbers are ASCII.
        Err(_) => Ok((Cow::Owned(bytes.iter().copied().map(char::from).collect()), true)),
    }
}

/// Parses a text as XML.
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
            "it declares a document type, which could load other files; remove the <!DOCTYPE …>".into(),
        ),
        roxmltree::Error::NodesLimitReached => refused(format!("it has more than {MAX_NODES} elements")),
        _ if !text.trim_start().starts_with('<') => refused(no_xml(text)),
        error => refused(worded(&error)),
    })
}

/// Says why a text without an element at its beginning is not XML.
fn no_xml(text: &str) -> String {
    let reason = if text.trim_start().is_empty() { "it is empty" } else { "it does not begin with <" };
    reason.to_owned()
}

/// The parser's message, with its line and column at the end.
fn worded(error: &roxmltree::Error) -> String {
    let message = error.to_string();
    let place = message.rsplit_once(" at ").and_then(|(words, at)| Some((words, at.split_once(':')?)));
    match place {
        Some((words, (line, column))) => format!("{words} (line {line}, column {column})"),
        None => message,
    }
}

/// Returns whether an element has this name, ignoring case and namespaces.
pub(super) fn is_named(node: Node<'_, '_>, name: &str) -> bool {
    node.is_element() && node.tag_name().name().eq_ignore_ascii_case(name)
}

/// Returns the elements `name` at any depth of `parent`, but not inside an element `except`.
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

/// Returns the next node outside `node` and inside `within`, in document order.
fn following<'a, 'i>(node: Node<'a, 'i>, within: Node<'a, 'i>) -> Option<Node<'a, 'i>> {
    node.ancestors().take_while(|ancestor| *ancestor != within).find_map(|ancestor| ancestor.next_sibling())
}

/// Returns all words of an element in document order: those of its texts and of `value` attributes inside it, or else
/// those of all its attributes. White space, commas, semicolons and brackets separate words.
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

/// Parses the numbers of an element, see [`words`].
pub(super) fn numbers(node: Node<'_, '_>) -> Result<Vec<f64>, HattError> {
    words(node).into_iter().map(|word| number(word, node)).collect()
}

/// Parses a finite number in `node`.
pub(super) fn number(word: &str, node: Node<'_, '_>) -> Result<f64, HattError> {
    word.parse().ok().filter(|value: &f64| value.is_finite()).ok_or_else(|| HattError::Number {
        element: node.tag_name().name().to_owned(),
        line: line_of(node),
        found: word.chars().take(40).collect(),
    })
}

/// Returns the line of a node, from one. This scans the file, so call it only for errors.
pub(super) fn line_of(node: Node<'_, '_>) -> u32 {
    node.document().text_pos_at(node.range().start).row
}

/// Returns the trimmed text of a single element; `None` if it is missing or empty.
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

/// Returns a single number, from an element or an attribute of `parent`; `None` if it is missing.
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

/// Returns the numbers of all elements `name` in sequence, or of the attribute of `parent` if there is no element.
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
