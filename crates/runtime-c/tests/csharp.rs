//! The bindings in C# fit the header: every imported function is declared there with as many parameters of the same kind, and
//! the structs and the status have the same values in the same order. `programs` compiles and runs them where Mono is.

#![allow(clippy::unwrap_used, reason = "tests")]

use std::collections::BTreeMap;
use std::path::Path;

fn read(path: &str) -> String {
    std::fs::read_to_string(Path::new(env!("CARGO_MANIFEST_DIR")).join(path)).unwrap()
}

fn header() -> String {
    read("include/shagreen.h")
}

fn bindings() -> String {
    read("../../examples/runtime/csharp/Shagreen.cs")
}

/// Code without comments, in one line.
fn code_of(text: &str) -> String {
    let mut code = String::new();
    for line in text.lines() {
        let line = line.split("//").next().unwrap_or_default().trim();
        if !(line.starts_with('#') || line.starts_with("/*") || line.starts_with('*')) {
            code.push_str(line);
            code.push(' ');
        }
    }
    code
}

/// Kinds of the parameters of each declared function, by its name.
fn functions(code: &str) -> BTreeMap<String, Vec<&'static str>> {
    let mut functions = BTreeMap::new();
    let mut rest = code;
    while let Some((before, after)) = rest.split_once('(') {
        let name = before.rsplit([' ', '*']).next().unwrap_or_default();
        let (parameters, following) = after.split_once(')').unwrap();
        // A declaration has a type before its name and ends after its parameters; a call has neither.
        let is_declaration = following.starts_with(';') && before.trim_end().len() > name.len();
        let words: Vec<&str> = before.split_whitespace().collect();
        let has_type = words.len() > 1 && !["return", "="].contains(&words[words.len() - 2]);
        if name.starts_with("shagreen_") && is_declaration && has_type && !before.ends_with('.') {
            let list = parameters.split(',').map(str::trim).filter(|one| !one.is_empty() && *one != "void");
            functions.insert(name.to_owned(), list.map(kind_of).collect());
        }
        rest = after;
    }
    functions
}

/// Kind of a parameter in C or C#.
fn kind_of(parameter: &str) -> &'static str {
    let is_pointer = ["*", "[]", "out ", "ref ", "IntPtr ", "TextureHandle ", "VoiceHandle "];
    match parameter {
        one if one.starts_with("UIntPtr ") || one.starts_with("size_t ") => "size",
        one if is_pointer.iter().any(|part| one.contains(part)) => "pointer",
        one if one.starts_with("float ") => "float",
        one if one.starts_with("int ") || one.starts_with("int32_t ") => "int",
        one if one.starts_with("ulong ") || one.starts_with("uint64_t ") => "ulong",
        other => unreachable!("an unknown kind of parameter: {other}"),
    }
}

/// Type and name of each field of a struct, in the words of C#.
fn fields(body: &str) -> Vec<String> {
    let types = [("uint64_t", "ulong"), ("uint32_t", "uint")];
    let field = |text: &str| {
        let mut words = text.trim().trim_start_matches("public ").split_whitespace();
        let (kind, name) = (words.next()?, words.next()?);
        let kind = types.iter().find(|(c, _)| *c == kind).map_or(kind, |(_, csharp)| csharp);
        Some(format!("{kind} {name}"))
    };
    body.split(';').filter_map(field).collect()
}

/// Text between the braces after a beginning.
fn body_after<'a>(code: &'a str, begin: &str) -> &'a str {
    let (_, rest) = code.split_once(begin).unwrap();
    rest.split_once('{').unwrap().1.split_once('}').unwrap().0
}

/// Text between the last opening brace before an end, and that end.
fn body_before<'a>(code: &'a str, end: &str) -> &'a str {
    code.split_once(end).unwrap().0.rsplit_once('{').unwrap().1
}

#[test]
fn imported_functions_are_those_of_the_header() {
    let (header, bindings) = (code_of(&header()), code_of(&bindings()));
    let (declared, imported) = (functions(&header), functions(&bindings));
    assert_eq!(declared.len(), 15, "{declared:?}");
    assert_eq!(imported, declared);
}

#[test]
fn structs_and_statuses_are_those_of_the_header() {
    let (header, bindings) = (code_of(&header()), code_of(&bindings()));
    for name in ["ShagreenTouch", "ShagreenInfo"] {
        let declared = fields(body_before(&header, &format!("}} {name};")));
        assert!(declared.len() > 3, "{declared:?}");
        assert_eq!(fields(body_after(&bindings, &format!("struct {name}"))), declared, "{name}");
    }
    let values = |body: &str, prefix: &str| -> Vec<String> {
        let value = |text: &str| text.replace(prefix, "").replace('_', "").to_lowercase().trim().to_owned();
        body.split(',').map(value).filter(|value| !value.is_empty()).collect()
    };
    let declared = values(body_before(&header, "} ShagreenStatus;"), "SHAGREEN_STATUS_");
    assert_eq!((declared.len(), declared[2].as_str()), (12, "toolong = 2"));
    assert_eq!(values(body_after(&bindings, "enum Status"), "Status."), declared);
}

/// Negative control.
#[test]
fn a_binding_that_does_not_fit_is_found() {
    let c = functions("ShagreenStatus shagreen_f(ShagreenVoice *voice, float x, size_t n);");
    let fits = functions("static extern Status shagreen_f(IntPtr voice, float x, UIntPtr n);");
    assert_eq!(c, fits);
    for other in [
        "static extern Status shagreen_f(IntPtr voice, float x);",
        "static extern Status shagreen_f(IntPtr voice, UIntPtr n, float x);",
        "static extern Status shagreen_g(IntPtr voice, float x, UIntPtr n);",
    ] {
        assert_ne!(functions(other), c, "{other}");
    }
    // A call is no declaration.
    let calls =
        "check(shagreen_f(voice, 1, 2)); return Native.shagreen_f(voice, x, n); x = shagreen_f(v, x, n);";
    assert!(functions(calls).is_empty(), "{:?}", functions(calls));
    assert_ne!(fields("double x_m; float y;"), fields("float x_m; float y;"));
}
