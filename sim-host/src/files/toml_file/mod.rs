//! Reads TOML files so that a mistake is answered with its place and what would be right.
//!
//! A reader asks each [`Section`] for its keys by name and gets plain values back; nothing returns early. Mistakes are
//! gathered on the way, keys that nobody asked for count as unknown, and the first mistake becomes the [`FileError`].

mod rule;
mod schema;
mod section;

use std::{cell::RefCell, fmt, rc::Rc};

use serde_json::Value;
use toml_edit::Document;

pub use rule::Rule;
pub use section::Section;

/// A mistake in a file: one line with file, line, column and what would be right.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct FileError {
    /// The file, as it was named.
    pub file: String,
    /// Line and column, from 1, if the mistake has a place.
    pub place: Option<(usize, usize)>,
    /// What is wrong and what would be right.
    pub message: String,
}

impl fmt::Display for FileError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.place {
            Some((line, column)) => write!(f, "{}:{line}:{column}: {}", self.file, self.message),
            None => write!(f, "{}: {}", self.file, self.message),
        }
    }
}

impl std::error::Error for FileError {}

/// A mistake and its byte offset in the text.
#[derive(Clone, Debug)]
struct Mistake {
    offset: usize,
    unknown_key: bool,
    message: String,
}

/// A file's text and the mistakes found in it so far.
struct Source<'a> {
    text: &'a str,
    mistakes: RefCell<Vec<Mistake>>,
    /// What was asked for, where a schema is wanted.
    schema: Option<Rc<RefCell<Value>>>,
}

impl Source<'_> {
    const fn is_described(&self) -> bool {
        self.schema.is_some()
    }

    fn describe(&self, path: &str, key: &str, required: bool, schema: impl FnOnce() -> Value) {
        if let Some(whole) = &self.schema {
            schema::add(&mut whole.borrow_mut(), path, key, required, schema());
        }
    }
}

/// The JSON Schema of a file: everything that `build` asks for, with its bounds.
#[must_use]
pub fn schema<T>(title: &str, build: impl FnOnce(&mut Section<'_>) -> T) -> Value {
    let whole = Rc::new(RefCell::new(schema::root(title)));
    let source = Source { text: "", mistakes: RefCell::default(), schema: Some(Rc::clone(&whole)) };
    section::read_root(&source, &toml_edit::Table::new(), build);
    drop(source);
    whole.take()
}

/// Parses a text and lets `build` read its root.
///
/// # Errors
/// The first mistake of the text; unknown keys come before all others, since a mistyped key is also a missing one.
pub fn read<T>(text: &str, file: &str, build: impl FnOnce(&mut Section<'_>) -> T) -> Result<T, FileError> {
    let fail = |offset: usize, message: &str| {
        Err(FileError { file: file.into(), place: Some(place(text, offset)), message: message.replace('\n', ", ") })
    };
    let document = match Document::parse(text) {
        Ok(document) => document,
        Err(error) => return fail(error.span().map_or(0, |span| span.start), error.message()),
    };
    let source = Source { text, mistakes: RefCell::default(), schema: None };
    let built = section::read_root(&source, document.as_table(), build);
    let mistakes = source.mistakes.into_inner();
    match mistakes.iter().min_by_key(|mistake| (!mistake.unknown_key, mistake.offset)) {
        Some(first) => fail(first.offset, &first.message),
        None => Ok(built),
    }
}

/// Line and column of the value under a dotted key, for mistakes that show only later.
#[must_use]
pub fn place_of(text: &str, dotted_key: &str) -> Option<(usize, usize)> {
    let document = Document::parse(text).ok()?;
    let mut keys = dotted_key.split('.');
    let first = document.as_table().get(keys.next()?)?;
    let item = keys.try_fold(first, |item, key| item.get(key))?;
    item.span().map(|span| place(text, span.start))
}

/// Line and column of a byte offset, from 1, columns in characters.
fn place(text: &str, offset: usize) -> (usize, usize) {
    let before = text.get(..offset).unwrap_or(text);
    let line_start = before.rfind('\n').map_or(0, |newline| newline + 1);
    (before.matches('\n').count() + 1, before[line_start..].chars().count() + 1)
}

/// The text of a file and the name to give it in errors: an embedded file if `argument` names one, else a path.
///
/// # Errors
/// One line that lists the embedded names, where `argument` is neither.
pub fn load<'a>(
    argument: &str,
    embedded: &[(&str, &'a str, &'a str)],
) -> Result<(std::borrow::Cow<'a, str>, String), FileError> {
    if let Some((_, file, text)) = embedded.iter().find(|(name, ..)| *name == argument) {
        return Ok(((*text).into(), (*file).into()));
    }
    std::fs::read_to_string(argument).map(|text| (text.into(), argument.to_owned())).map_err(|error| {
        let names: Vec<_> = embedded.iter().map(|(name, ..)| format!("`{name}`")).collect();
        let message = format!("not a readable file ({error}), nor an embedded one ({})", names.join(", "));
        FileError { file: argument.into(), place: None, message }
    })
}
