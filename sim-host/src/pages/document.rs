//! A document that is written twice: as Markdown for a forge, and as a page that needs nothing else.

use std::{fs, io::Write, path::Path};

use maud::{Markup, PreEscaped, html};

use crate::files::whole_file;
use crate::pages::{chart::Figure, page::page};

/// A title and what stands below it.
#[derive(Clone, Debug)]
pub(crate) struct Document {
    /// Its title.
    pub(crate) title: String,
    /// In order.
    pub(crate) blocks: Vec<Block>,
}

/// A part of a document. Words are plain: no markup of either kind.
#[derive(Clone, Debug)]
pub(crate) enum Block {
    /// The head of a section.
    Heading(String),
    /// A paragraph.
    Text(String),
    /// Sentences, one below the other.
    List(Vec<String>),
    /// What one types.
    Code(String),
    /// Rows below their heads.
    Table(Table),
    /// A picture, by the name of its file without extension.
    Figure(String, Box<Figure>),
    /// What is shown to those who ask for it: a line to ask by, and the blocks behind it.
    Folded(String, Vec<Self>),
}

/// A table.
#[derive(Clone, Debug)]
pub(crate) struct Table {
    /// The heads.
    pub(crate) columns: Vec<Column>,
    /// The rows.
    pub(crate) rows: Vec<Row>,
}

/// The head of a column.
#[derive(Clone, Debug)]
pub(crate) enum Column {
    /// Of words.
    Words(String),
    /// Of numbers.
    Number(String),
}

/// A row.
#[derive(Clone, Debug)]
pub(crate) struct Row {
    /// One for each column.
    pub(crate) cells: Vec<String>,
    /// Something was promised and is not so: the row stands out, and so does its last cell.
    pub(crate) missed: bool,
}

impl Column {
    const fn name(&self) -> &String {
        match self {
            Self::Words(name) | Self::Number(name) => name,
        }
    }

    const fn class(&self) -> Option<&'static str> {
        match self {
            Self::Words(_) => None,
            Self::Number(_) => Some("number"),
        }
    }
}

impl Document {
    /// Both forms and the pictures, into a folder; `name` is that of the files.
    ///
    /// # Errors
    /// One line that names the file that could not be written.
    pub(crate) fn write(&self, folder: &Path, name: &str) -> Result<(), String> {
        fs::create_dir_all(folder).map_err(|error| format!("{}: {error}", folder.display()))?;
        for (name, figure) in figures(&self.blocks) {
            whole_file::write(&folder.join(format!("{name}.svg")), |file| writeln!(file, "{}", figure.svg()))?;
        }
        whole_file::write(&folder.join(format!("{name}.md")), |file| writeln!(file, "{}", self.markdown()))?;
        whole_file::write(&folder.join(format!("{name}.html")), |file| writeln!(file, "{}", self.page()))
    }

    fn markdown(&self) -> String {
        format!("# {}\n\n{}", self.title, in_markdown(&self.blocks))
    }

    fn page(&self) -> String {
        let body = html! { h1 { (self.title) } @for block in &self.blocks { (block.in_html()) } };
        page(&self.title, include_str!("document.css"), &body)
    }
}

fn figures(blocks: &[Block]) -> Vec<(&str, &Figure)> {
    let mut all = Vec::new();
    for block in blocks {
        match block {
            Block::Figure(name, figure) => all.push((name.as_str(), figure.as_ref())),
            Block::Folded(_, blocks) => all.extend(figures(blocks)),
            Block::Heading(_) | Block::Text(_) | Block::List(_) | Block::Code(_) | Block::Table(_) => {}
        }
    }
    all
}

fn in_markdown(blocks: &[Block]) -> String {
    blocks.iter().map(Block::in_markdown).collect::<Vec<_>>().join("\n\n")
}

impl Block {
    fn in_markdown(&self) -> String {
        match self {
            Self::Heading(words) => format!("## {words}"),
            Self::Text(words) => words.clone(),
            Self::List(items) => items.iter().map(|item| format!("* {item}")).collect::<Vec<_>>().join("\n"),
            Self::Code(lines) => format!("```sh\n{lines}\n```"),
            Self::Table(table) => table.in_markdown(),
            Self::Figure(name, figure) => format!("![{}]({name}.svg)", figure.title),
            Self::Folded(line, blocks) => {
                format!("<details><summary>{line}</summary>\n\n{}\n\n</details>", in_markdown(blocks))
            }
        }
    }

    fn in_html(&self) -> Markup {
        html! {
            @match self {
                Self::Heading(words) => h2 { (words) },
                Self::Text(words) => p { (words) },
                Self::List(items) => ul { @for item in items { li { (item) } } },
                Self::Code(lines) => pre { (lines) },
                Self::Table(table) => (table.in_html()),
                Self::Figure(_, figure) => div.figure { (PreEscaped(figure.svg())) },
                Self::Folded(line, blocks) => details {
                    summary { (line) }
                    @for block in blocks { (block.in_html()) }
                },
            }
        }
    }
}

impl Table {
    fn in_markdown(&self) -> String {
        let line = |cells: &mut dyn Iterator<Item = String>| format!("| {} |", cells.collect::<Vec<_>>().join(" | "));
        let rule = |column: &Column| if column.class().is_some() { "---:" } else { "---" }.to_owned();
        let mut lines = vec![
            line(&mut self.columns.iter().map(|column| cell_in_markdown(column.name()))),
            line(&mut self.columns.iter().map(rule)),
        ];
        lines.extend(self.rows.iter().map(|row| {
            let last = row.cells.len().saturating_sub(1);
            line(&mut row.cells.iter().enumerate().map(|(index, cell)| {
                let cell = cell_in_markdown(cell);
                if row.missed && index == last { format!("**{cell}**") } else { cell }
            }))
        }));
        lines.join("\n")
    }

    fn in_html(&self) -> Markup {
        html! {
            div.scroll {
                table {
                    thead { tr { @for column in &self.columns { th class=[column.class()] { (column.name()) } } } }
                    tbody {
                        @for row in &self.rows {
                            tr.missed[row.missed] {
                                @for (column, cell) in self.columns.iter().zip(&row.cells) {
                                    td class=[column.class()] { (cell) }
                                }
                            }
                        }
                    }
                }
            }
        }
    }
}

/// A bar would end the cell.
fn cell_in_markdown(words: &str) -> String {
    words.replace('|', "\\|")
}

#[cfg(test)]
mod tests {
    use super::*;

    fn document() -> Document {
        let row = |cells: [&str; 2], missed| Row { cells: cells.map(str::to_owned).into(), missed };
        let table = Table {
            columns: vec![Column::Words("what".into()), Column::Number("how much".into())],
            rows: vec![row(["a|b", "1"], false), row(["c < d", "2"], true)],
        };
        Document { title: "T & U".into(), blocks: vec![Block::Folded("more".into(), vec![Block::Table(table)])] }
    }

    #[test]
    fn markdown_keeps_its_columns_and_marks_what_was_missed() {
        let text = document().markdown();
        assert!(text.contains("| what | how much |\n| --- | ---: |\n| a\\|b | 1 |\n| c < d | **2** |"), "{text}");
    }

    #[test]
    fn the_page_escapes_words_and_marks_what_was_missed() {
        let page = document().page();
        assert!(page.contains("<h1>T &amp; U</h1>") && page.contains("<summary>more</summary>"), "{page}");
        assert!(page.contains("<tr class=\"missed\"><td>c &lt; d</td><td class=\"number\">2</td></tr>"), "{page}");
    }
}
