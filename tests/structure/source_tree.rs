//! Modules of a crate and the imports between them, read from the source text.
//!
//! An import is a `use` declaration or a path that begins with `crate::`, `self::`, `super::` or a child module. It
//! leads to the module that defines the name: re-exports (`pub use`) are followed. Comments, contents of strings and
//! test modules are ignored.

use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;

/// Path of a module below the crate's root, which has the empty path.
pub(crate) type ModulePath = Vec<String>;

/// Imports of every module of a crate.
#[derive(Debug, Default)]
pub(crate) struct SourceTree {
    modules: BTreeMap<ModulePath, Imports>,
}

/// Paths that one module names.
#[derive(Debug, Default)]
struct Imports {
    /// Paths of private imports and of expressions.
    used: Vec<Vec<String>>,
    /// Paths of `pub use` declarations, which the module re-exports.
    handed_on: Vec<Vec<String>>,
}

impl SourceTree {
    /// Reads the modules below a `src` folder. Files and folders named `tests` are skipped.
    pub(crate) fn read(src: &Path) -> Self {
        let mut files = Vec::new();
        collect(src, &mut Vec::new(), &mut files);
        Self::of(files.into_iter())
    }

    /// Creates the tree of these texts.
    pub(crate) fn of<T: AsRef<str>>(files: impl Iterator<Item = (ModulePath, T)>) -> Self {
        Self { modules: files.map(|(path, text)| (path, Imports::of(&code_of(text.as_ref())))).collect() }
    }

    /// Number of modules.
    pub(crate) fn n_modules(&self) -> usize {
        self.modules.len()
    }

    /// Returns, for each module, the modules that it imports from.
    pub(crate) fn arrows(&self) -> BTreeMap<ModulePath, BTreeSet<ModulePath>> {
        let of_module = |(from, imports): (&ModulePath, &Imports)| {
            let named = imports.used.iter().filter_map(|path| self.absolute(from, path));
            let to: BTreeSet<ModulePath> =
                named.map(|path| self.definition(&path, 0)).filter(|to| to != from).collect();
            (from.clone(), to)
        };
        self.modules.iter().map(of_module).collect()
    }

    /// Returns the path from the crate's root; `None` if it leads out of the crate.
    fn absolute(&self, from: &ModulePath, path: &[String]) -> Option<Vec<String>> {
        let mut base = from.clone();
        let mut rest = path;
        match rest.first()?.as_str() {
            "crate" => (base, rest) = (Vec::new(), &rest[1..]),
            "self" => rest = &rest[1..],
            "super" => {
                while rest.first().is_some_and(|part| part == "super") {
                    base.pop();
                    rest = &rest[1..];
                }
            }
            child => {
                base.push(child.to_owned());
                self.modules.get(&base)?;
                rest = &rest[1..];
            }
        }
        base.extend(rest.iter().cloned());
        Some(base)
    }

    /// Returns the module that defines the name at a path from the root.
    fn definition(&self, path: &[String], depth: usize) -> ModulePath {
        let n_module = (0..=path.len()).rev().find(|n| self.modules.contains_key(&path[..*n])).unwrap_or(0);
        let module = path[..n_module].to_vec();
        let Some(name) = path.get(n_module).filter(|_| depth < 8) else { return module };
        let handed_on = self.modules.get(&module).into_iter().flat_map(|imports| &imports.handed_on);
        let source =
            handed_on.filter(|path| path.last() == Some(name)).find_map(|path| self.absolute(&module, path));
        match source.filter(|source| source.as_slice() != path) {
            Some(source) => self.definition(&source, depth + 1),
            None => module,
        }
    }
}

impl Imports {
    fn of(code: &str) -> Self {
        let mut imports = Self::default();
        let mut rest = String::new();
        // Declarations end at semicolons, which no path contains.
        for statement in code.split_inclusive(';') {
            let begin = statement.rfind("use ").filter(|begin| {
                let before = statement[..*begin].chars().next_back();
                before.is_none_or(|c| c.is_whitespace() || c == ')')
                    && !statement[*begin..].contains(['=', '('])
            });
            let Some(begin) = begin else {
                rest.push_str(statement);
                continue;
            };
            rest.push_str(&statement[..begin]);
            let line = statement[..begin].rsplit('\n').next().unwrap_or_default().trim();
            let tree = statement[begin + 4..].trim_end_matches(';');
            let mut paths = Vec::new();
            expand(&[], tree, &mut paths);
            if line.starts_with("pub") { &mut imports.handed_on } else { &mut imports.used }.extend(paths);
        }
        imports.used.extend(qualified_paths(&rest));
        imports
    }
}

/// Collects the paths of a `use` tree.
fn expand(prefix: &[String], tree: &str, paths: &mut Vec<Vec<String>>) {
    let tree = tree.trim();
    if tree.is_empty() {
        return;
    }
    let parts = |text: &str| -> Vec<String> {
        text.split("::").map(str::trim).filter(|part| !part.is_empty()).map(str::to_owned).collect()
    };
    let Some(open) = tree.find('{') else {
        let tree = tree.split(" as ").next().unwrap_or(tree);
        let mut path = [prefix, &parts(tree)].concat();
        if path.len() > 1 && path.last().is_some_and(|last| last == "self") {
            path.pop();
        }
        paths.push(path);
        return;
    };
    let prefix = [prefix, &parts(&tree[..open])].concat();
    let inner = &tree[open + 1..tree.rfind('}').unwrap_or(tree.len())];
    let (mut depth, mut begin) = (0_usize, 0);
    for (i, c) in inner.char_indices() {
        match c {
            '{' => depth += 1,
            '}' => depth = depth.saturating_sub(1),
            ',' if depth == 0 => {
                expand(&prefix, &inner[begin..i], paths);
                begin = i + 1;
            }
            _ => {}
        }
    }
    expand(&prefix, &inner[begin..], paths);
}

/// Returns the paths in expressions and types that begin with `crate`, `self` or `super`.
fn qualified_paths(code: &str) -> Vec<Vec<String>> {
    let is_part = |c: char| c.is_alphanumeric() || c == '_' || c == ':';
    let words = code.split(|c: char| !is_part(c));
    let path = |word: &str| -> Vec<String> {
        word.split("::").take_while(|part| !part.is_empty()).map(str::to_owned).collect()
    };
    let begins = ["crate::", "self::", "super::"];
    words.filter(|word| begins.iter().any(|begin| word.starts_with(begin))).map(path).collect()
}

/// Returns a text without comments, contents of plain strings, and its test module.
fn code_of(text: &str) -> String {
    let text = text.split("#[cfg(test)]\nmod tests {").next().unwrap_or(text);
    let mut code = String::with_capacity(text.len());
    for line in text.lines() {
        let mut is_in_string = false;
        let mut before = ' ';
        let mut chars = line.chars().peekable();
        while let Some(c) = chars.next() {
            if !is_in_string && c == '/' && chars.peek() == Some(&'/') {
                break;
            }
            let is_quote = c == '"' && before != '\\' && before != '\'';
            if is_quote {
                is_in_string = !is_in_string;
            }
            if !is_in_string || is_quote {
                code.push(c);
            }
            before = if before == '\\' && c == '\\' { ' ' } else { c };
        }
        code.push('\n');
    }
    code
}

fn collect(folder: &Path, module: &mut ModulePath, files: &mut Vec<(ModulePath, String)>) {
    let entries = std::fs::read_dir(folder).expect("a folder of source files");
    for path in entries.map(|entry| entry.expect("an entry").path()) {
        let stem = path.file_stem().and_then(|stem| stem.to_str()).expect("a name in ASCII").to_owned();
        if stem == "tests" {
            continue;
        }
        if path.is_dir() {
            module.push(stem);
            collect(&path, module, files);
            module.pop();
        } else if path.extension().is_some_and(|extension| extension == "rs") {
            let is_root = module.is_empty() && (stem == "lib" || stem == "main");
            let own = if is_root { Vec::new() } else { [module.as_slice(), &[stem]].concat() };
            files.push((own, std::fs::read_to_string(&path).expect("a source file")));
        }
    }
}
