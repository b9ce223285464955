//! The shell of a page that needs nothing else.

use maud::{DOCTYPE, Markup, PreEscaped, html};

/// The style of pages of figures and short tables.
pub(crate) const STYLE: &str = include_str!("page.css");

/// A whole HTML document: its title, its style and its body.
pub(crate) fn page(title: &str, style: &str, body: &Markup) -> String {
    let page = html! {
        (DOCTYPE)
        html lang="en" {
            head {
                meta charset="utf-8";
                meta name="viewport" content="width=device-width, initial-scale=1";
                title { (title) }
                style { (PreEscaped(style)) }
            }
            body { (body) }
        }
    };
    page.into_string()
}
