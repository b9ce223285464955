//! One table of a file, asked key by key.

use std::ops::RangeInclusive;

use nalgebra::Matrix3;
use toml_edit::{Item, Table, TableLike, Value};

use super::{Mistake, Rule, Source, schema};

/// Likeness from which a key is taken for a mistyped one (Jaro–Winkler, 0 to 1).
const LIKENESS: f64 = 0.8;
/// Longest value quoted in a message, characters.
const QUOTED_CHARS: usize = 40;

/// One table of a file. Every question marks its key as known.
pub struct Section<'a> {
    source: &'a Source<'a>,
    table: &'a dyn TableLike,
    /// Names of the tables down to this one; empty at the root.
    path: String,
    /// Where the table begins in the text.
    offset: usize,
    asked: Vec<&'static str>,
}

/// Reads the root table.
pub(super) fn read_root<'a, T>(
    source: &'a Source<'a>,
    root: &'a Table,
    build: impl FnOnce(&mut Section<'_>) -> T,
) -> T {
    Section { source, table: root, path: String::new(), offset: 0, asked: Vec::new() }.read(build)
}

impl Section<'_> {
    fn read<T>(mut self, build: impl FnOnce(&mut Section<'_>) -> T) -> T {
        let built = build(&mut self);
        for (key, _) in self.table.iter().filter(|(key, _)| !self.asked.contains(key)) {
            let offset = self.key_offset(key);
            let message = format!("unknown key `{key}`; {}", self.suggest(key));
            self.source.mistakes.borrow_mut().push(Mistake { offset, unknown_key: true, message });
        }
        built
    }

    /// Reads a table that must be there.
    pub fn section<T>(&mut self, key: &'static str, build: impl FnOnce(&mut Section<'_>) -> T) -> T {
        let missing = format!("missing section `{}`", self.full(key));
        self.section_or_else(key, missing, build)
    }

    /// Reads a table that must be there, with a message of one's own if it is not.
    pub fn section_or_else<T>(
        &mut self,
        key: &'static str,
        missing: String,
        build: impl FnOnce(&mut Section<'_>) -> T,
    ) -> T {
        self.describe(key, true, schema::section);
        if !self.has(key) {
            self.mistake(self.offset, missing);
        }
        self.present_section(key, build)
    }

    /// Reads a table that may be left out.
    pub fn optional_section<T>(&mut self, key: &'static str, build: impl FnOnce(&mut Section<'_>) -> T) -> Option<T> {
        self.describe(key, false, schema::section);
        (self.has(key) || self.source.is_described()).then(|| self.present_section(key, build))
    }

    /// Reads a table; in place of a missing one an empty one, whose missing keys are no further mistakes.
    fn present_section<T>(&mut self, key: &'static str, build: impl FnOnce(&mut Section<'_>) -> T) -> T {
        let path = self.full(key);
        let empty = Table::new();
        let unheard =
            Source { text: self.source.text, mistakes: Default::default(), schema: self.source.schema.clone() };
        match self.item(key).map(|item| (item, item.as_table_like())) {
            Some((item, Some(table))) => {
                let offset = item.span().map_or_else(|| self.key_offset(key), |span| span.start);
                Section { source: self.source, table, path, offset, asked: Vec::new() }.read(build)
            }
            other => {
                if other.is_some() {
                    self.reject(key, "a table");
                }
                Section { source: &unheard, table: &empty, path, offset: 0, asked: Vec::new() }.read(build)
            }
        }
    }

    /// A number that must be there.
    pub fn number(&mut self, key: &'static str, rule: Rule) -> f64 {
        self.describe(key, true, || rule.schema());
        self.required(key, &rule.to_string(), |value| number(value).filter(|number| rule.holds(*number)))
            .unwrap_or(f64::NAN)
    }

    /// A number that may be left out.
    pub fn number_or(&mut self, key: &'static str, rule: Rule, default: f64) -> f64 {
        self.describe(key, false, || schema::with_default(rule.schema(), default));
        if self.has(key) { self.number(key, rule) } else { default }
    }

    /// A number that may be left out, without a default.
    pub fn optional_number(&mut self, key: &'static str, rule: Rule) -> Option<f64> {
        self.describe(key, false, || rule.schema());
        self.has(key).then(|| self.number(key, rule))
    }

    /// A whole number that must be there.
    pub fn integer(&mut self, key: &'static str, bounds: RangeInclusive<i64>) -> i64 {
        self.describe(key, true, || schema::integer(&bounds));
        let right = format!("a whole number from {} to {}", bounds.start(), bounds.end());
        let accept = |value: &Value| value.as_integer().filter(|integer| bounds.contains(integer));
        self.required(key, &right, accept).unwrap_or(*bounds.start())
    }

    /// A whole number that may be left out.
    pub fn integer_or(&mut self, key: &'static str, bounds: RangeInclusive<i64>, default: i64) -> i64 {
        self.describe(key, false, || schema::with_default(schema::integer(&bounds), default));
        if self.has(key) { self.integer(key, bounds) } else { default }
    }

    /// A text of 1 to `longest` characters.
    pub fn text(&mut self, key: &'static str, longest: usize) -> String {
        self.describe(key, true, || schema::text(longest));
        let right = format!("a text of 1 to {longest} characters");
        let accept = |value: &Value| {
            value.as_str().filter(|text| (1..=longest).contains(&text.chars().count())).map(ToOwned::to_owned)
        };
        self.required(key, &right, accept).unwrap_or_default()
    }

    /// A text that may be left out.
    pub fn optional_text(&mut self, key: &'static str, longest: usize) -> Option<String> {
        self.describe(key, false, || schema::text(longest));
        self.has(key).then(|| self.text(key, longest))
    }

    /// One of several words; the first of them if the key is left out.
    pub fn choice_or_first<T: Copy>(&mut self, key: &'static str, words: &[(&str, T)]) -> Option<T> {
        self.describe(key, false, || schema::choice(words.iter().map(|(word, _)| *word)));
        let names: Vec<_> = words.iter().map(|(word, _)| format!("\"{word}\"")).collect();
        if !self.has(key) {
            return words.first().map(|(_, choice)| *choice);
        }
        self.required(key, &names.join(" or "), |value| {
            words.iter().find(|(word, _)| value.as_str() == Some(word)).map(|(_, choice)| *choice)
        })
    }

    /// `true` or `false`, and `default` if it is left out.
    pub fn flag_or(&mut self, key: &'static str, default: bool) -> bool {
        if self.has(key) { self.required(key, "true or false", Value::as_bool).unwrap_or(default) } else { default }
    }

    /// A list of `N` numbers.
    pub fn numbers<const N: usize>(&mut self, key: &'static str, rule: Rule) -> [f64; N] {
        self.describe(key, true, || schema::list(rule.schema(), N, N));
        self.required(key, &format!("{N} numbers, each {rule}"), |value| numbers(value, rule)).unwrap_or([f64::NAN; N])
    }

    /// A list of `N` numbers that may be left out.
    pub fn numbers_or<const N: usize>(&mut self, key: &'static str, rule: Rule, default: [f64; N]) -> [f64; N] {
        self.describe(key, false, || schema::with_default(schema::list(rule.schema(), N, N), default.as_slice()));
        if self.has(key) { self.numbers(key, rule) } else { default }
    }

    /// A list of `N` numbers that may be left out, without a default.
    pub fn optional_numbers<const N: usize>(&mut self, key: &'static str, rule: Rule) -> Option<[f64; N]> {
        self.describe(key, false, || schema::list(rule.schema(), N, N));
        self.has(key).then(|| self.numbers(key, rule))
    }

    /// A list of 1 to `longest` numbers.
    pub fn list(&mut self, key: &'static str, rule: Rule, longest: usize) -> Vec<f64> {
        self.describe(key, true, || schema::list(rule.schema(), 1, longest));
        let accept = |value: &Value| {
            let list: Option<Vec<f64>> = value.as_array()?.iter().map(number).collect();
            list.filter(|list| (1..=longest).contains(&list.len()) && list.iter().all(|item| rule.holds(*item)))
        };
        self.required(key, &format!("1 to {longest} numbers, each {rule}"), accept).unwrap_or_default()
    }

    /// A list of 1 to `longest` numbers that may be left out.
    pub fn optional_list(&mut self, key: &'static str, rule: Rule, longest: usize) -> Option<Vec<f64>> {
        self.describe(key, false, || schema::list(rule.schema(), 1, longest));
        self.has(key).then(|| self.list(key, rule, longest))
    }

    /// `[min, max]` with min below max.
    pub fn range(&mut self, key: &'static str) -> [f64; 2] {
        self.describe(key, true, || schema::list(Rule::Finite.schema(), 2, 2));
        let accept = |value: &Value| numbers(value, Rule::Finite).filter(|[min, max]| min < max);
        self.required(key, "[min, max] with min below max", accept).unwrap_or([f64::NAN; 2])
    }

    /// `[min, max]` with min below max, that may be left out.
    pub fn optional_range(&mut self, key: &'static str) -> Option<[f64; 2]> {
        self.describe(key, false, || schema::list(Rule::Finite.schema(), 2, 2));
        self.has(key).then(|| self.range(key))
    }

    /// A 3×3 matrix, by rows.
    pub fn matrix(&mut self, key: &'static str) -> Matrix3<f64> {
        self.describe(key, true, || schema::list(schema::list(Rule::Finite.schema(), 3, 3), 3, 3));
        let right = "3 rows of 3 finite numbers";
        let rows = self.required(key, right, |value| <[[f64; 3]; 3]>::try_from(rows(value)?).ok());
        rows.map_or(Matrix3::from_element(f64::NAN), |rows| Matrix3::from_fn(|row, column| rows[row][column]))
    }

    /// Rows of two numbers.
    pub fn pairs(&mut self, key: &'static str) -> Vec<[f64; 2]> {
        self.describe(key, true, || schema::rows(2));
        self.required(key, "rows of 2 finite numbers", rows).unwrap_or_default()
    }

    /// Rows of two numbers that may be left out.
    pub fn optional_pairs(&mut self, key: &'static str) -> Option<Vec<[f64; 2]>> {
        self.describe(key, false, || schema::rows(2));
        self.has(key).then(|| self.pairs(key))
    }

    /// Rows of three numbers.
    pub fn triples(&mut self, key: &'static str) -> Vec<[f64; 3]> {
        self.describe(key, true, || schema::rows(3));
        self.required(key, "rows of 3 finite numbers", rows).unwrap_or_default()
    }

    /// Rows of four numbers.
    pub fn quadruples(&mut self, key: &'static str) -> Vec<[f64; 4]> {
        self.describe(key, true, || schema::rows(4));
        self.required(key, "rows of 4 finite numbers", rows).unwrap_or_default()
    }

    /// Refuses the value of a key for what several values show together.
    pub fn refuse_if(&mut self, wrong: bool, key: &'static str, right: &str) {
        if wrong {
            self.reject(key, right);
        }
    }

    /// Notes what the key may hold, where a schema is asked for; the first note of a key counts.
    fn describe(&self, key: &'static str, required: bool, schema: impl FnOnce() -> serde_json::Value) {
        self.source.describe(&self.path, key, required, schema);
    }

    /// Whether the key is there; asking marks it as known.
    fn has(&mut self, key: &'static str) -> bool {
        if !self.asked.contains(&key) {
            self.asked.push(key);
        }
        self.item(key).is_some()
    }

    fn required<T>(&mut self, key: &'static str, right: &str, accept: impl FnOnce(&Value) -> Option<T>) -> Option<T> {
        if !self.has(key) {
            self.mistake(self.offset, format!("missing key `{}`: {right}", self.full(key)));
            return None;
        }
        let accepted = self.item(key).and_then(Item::as_value).and_then(accept);
        if accepted.is_none() {
            self.reject(key, right);
        }
        accepted
    }

    fn reject(&self, key: &str, right: &str) {
        let span = self.item(key).and_then(Item::span);
        let offset = span.clone().map_or_else(|| self.key_offset(key), |span| span.start);
        let written = span.and_then(|span| self.source.text.get(span)).unwrap_or_default();
        let mut quoted: String = written.split_whitespace().collect::<Vec<_>>().join(" ");
        if quoted.chars().count() > QUOTED_CHARS {
            quoted = quoted.chars().take(QUOTED_CHARS).chain("…".chars()).collect();
        }
        self.mistake(offset, format!("`{}` is {quoted}, but must be {right}", self.full(key)));
    }

    fn mistake(&self, offset: usize, message: String) {
        self.source.mistakes.borrow_mut().push(Mistake { offset, unknown_key: false, message });
    }

    fn item(&self, key: &str) -> Option<&Item> {
        self.table.get(key).filter(|item| !item.is_none())
    }

    fn full(&self, key: &str) -> String {
        if self.path.is_empty() { key.into() } else { format!("{}.{key}", self.path) }
    }

    fn key_offset(&self, key: &str) -> usize {
        self.table.key(key).and_then(toml_edit::Key::span).map_or(self.offset, |span| span.start)
    }

    fn suggest(&self, key: &str) -> String {
        let likeness = |known: &str| strsim::jaro_winkler(key, known);
        match self.asked.iter().max_by(|a, b| likeness(a).total_cmp(&likeness(b))) {
            Some(nearest) if likeness(nearest) > LIKENESS => format!("did you mean `{nearest}`?"),
            _ => {
                let known: Vec<_> = self.asked.iter().map(|known| format!("`{known}`")).collect();
                format!("known here: {}", known.join(", "))
            }
        }
    }
}

fn number(value: &Value) -> Option<f64> {
    value.as_float().or_else(|| value.as_integer().map(|integer| integer as f64))
}

fn numbers<const N: usize>(value: &Value, rule: Rule) -> Option<[f64; N]> {
    let list: Option<Vec<f64>> = value.as_array()?.iter().map(number).collect();
    <[f64; N]>::try_from(list?).ok().filter(|list| list.iter().all(|item| rule.holds(*item)))
}

fn rows<const N: usize>(value: &Value) -> Option<Vec<[f64; N]>> {
    value.as_array()?.iter().map(|row| numbers(row, Rule::Finite)).collect()
}
