//! What a file may hold, in the words of JSON Schema.

use std::ops::RangeInclusive;

use serde_json::{Value, json};

/// A whole file without keys yet.
pub(super) fn root(title: &str) -> Value {
    let mut root = section();
    root["$schema"] = "https://json-schema.org/draft/2020-12/schema".into();
    root["title"] = title.into();
    root
}

/// A table without keys yet.
pub(super) fn section() -> Value {
    json!({ "type": "object", "properties": {}, "required": [], "additionalProperties": false })
}

pub(super) fn integer(bounds: &RangeInclusive<i64>) -> Value {
    json!({ "type": "integer", "minimum": bounds.start(), "maximum": bounds.end() })
}

pub(super) fn text(longest: usize) -> Value {
    json!({ "type": "string", "minLength": 1, "maxLength": longest })
}

pub(super) fn choice<'a>(words: impl Iterator<Item = &'a str>) -> Value {
    json!({ "enum": words.collect::<Vec<_>>() })
}

pub(super) fn list(item: Value, fewest: usize, most: usize) -> Value {
    json!({ "type": "array", "items": item, "minItems": fewest, "maxItems": most })
}

/// Any number of rows of numbers.
pub(super) fn rows(columns: usize) -> Value {
    json!({ "type": "array", "items": list(json!({ "type": "number" }), columns, columns) })
}

pub(super) fn with_default(mut schema: Value, default: impl Into<Value>) -> Value {
    schema["default"] = default.into();
    schema
}

/// Adds a key to the table at a dotted path, unless it is there already.
pub(super) fn add(root: &mut Value, path: &str, key: &str, required: bool, schema: Value) {
    let names = path.split('.').filter(|name| !name.is_empty());
    let table = names.fold(root, |table, name| &mut table["properties"][name]);
    if table["properties"].get(key).is_some() {
        return;
    }
    table["properties"][key] = schema;
    if required && let Some(list) = table["required"].as_array_mut() {
        list.push(key.into());
    }
}

#[cfg(test)]
mod tests {
    use super::super::{Rule, schema};
    use serde_json::json;

    #[test]
    fn a_schema_says_what_the_reader_asks() {
        let asked = schema("a file", |file| {
            file.section("dive", |dive| {
                [dive.number("depth_m", Rule::Positive), dive.number_or("rest_s", Rule::NotNegative, 2.0)]
            });
            file.optional_section("tuning", |tuning| tuning.integer("gain", 1..=5))
        });
        let depth = json!({ "type": "number", "exclusiveMinimum": 0 });
        let rest = json!({ "type": "number", "minimum": 0, "default": 2.0 });
        assert_eq!(asked["properties"]["dive"]["properties"], json!({ "depth_m": depth, "rest_s": rest }));
        assert_eq!(asked["properties"]["dive"]["required"], json!(["depth_m"]));
        assert_eq!(asked["required"], json!(["dive"]));
        assert_eq!(asked["properties"]["tuning"]["properties"]["gain"]["maximum"], 5);
    }
}
