//! A table as a list of columns: what each says of a line, in which unit, and where it comes from.

use std::collections::HashMap;
use std::fmt::Display;
use std::path::{Path, PathBuf};
use std::str::FromStr;

/// Why a table cannot be read.
#[derive(Debug, thiserror::Error)]
pub enum TableError {
    /// The operating system refuses.
    #[error("{}: {cause}", path.display())]
    Io {
        /// The file.
        path: PathBuf,
        /// What the system says.
        cause: std::io::Error,
    },
    /// What stands there is not what a run writes.
    #[error("{}:{line}: {problem}; run the experiment again, or take the file from a checkout", path.display())]
    Line {
        /// The file.
        path: PathBuf,
        /// The line, from 1.
        line: u64,
        /// What is wrong.
        problem: String,
    },
}

/// What a line says in a column, if anything.
type Value<R> = Box<dyn Fn(&R) -> Option<String>>;

/// A column of lines of type `R`.
pub struct Column<R> {
    /// Its name in the head.
    pub name: String,
    /// What it is, with its unit; a line of the documentation.
    #[cfg_attr(not(test), expect(dead_code, reason = "a test writes docs/rows.md from it"))]
    pub about: String,
    /// Section or statement of the paper, if it has one.
    #[cfg_attr(not(test), expect(dead_code, reason = "a test writes docs/rows.md from it"))]
    pub paper: &'static str,
    /// What a reader takes where the column is missing: it is left out of a table whose lines all say this or nothing.
    pub default: Option<&'static str>,
    value: Value<R>,
}

impl<R> Column<R> {
    /// A column; `value` is what a line says, nothing where it has nothing to say.
    pub fn new(name: &str, about: &str, value: impl Fn(&R) -> Option<String> + 'static) -> Self {
        Self {
            name: name.into(),
            about: about.into(),
            paper: "",
            default: None,
            value: Box::new(value),
        }
    }

    /// Where the paper has it.
    pub fn paper(self, paper: &'static str) -> Self {
        Self { paper, ..self }
    }

    /// What it says where it is left out.
    pub fn or(self, default: impl Into<Option<&'static str>>) -> Self {
        Self {
            default: default.into(),
            ..self
        }
    }
}

/// The table of `lines`: a head, then a line each. Columns that say the same default, or nothing, on all lines are left out;
/// the first is always there.
pub fn write<R>(columns: &[Column<R>], lines: &[R]) -> String {
    let columns: Vec<(&str, Vec<String>)> = columns
        .iter()
        .enumerate()
        .filter_map(|(place, column)| {
            let values: Vec<Option<String>> = lines.iter().map(|line| (column.value)(line)).collect();
            let says_something = values
                .iter()
                .any(|value| value.is_some() && value.as_deref() != column.default);
            let values = || values.into_iter().map(Option::unwrap_or_default).collect();
            (place == 0 || says_something).then(|| (column.name.as_str(), values()))
        })
        .collect();
    let mut writer = csv::Writer::from_writer(Vec::new());
    // Writing to memory does not fail, and all lines have as many fields as the head.
    let _ = writer.write_record(columns.iter().map(|(name, _)| name));
    for line in 0..lines.len() {
        let _ = writer.write_record(columns.iter().map(|(_, values)| &values[line]));
    }
    String::from_utf8_lossy(&writer.into_inner().unwrap_or_default()).into_owned()
}

/// A table that was read.
pub struct Table {
    path: PathBuf,
    places: HashMap<String, usize>,
    head: Vec<String>,
    lines: Vec<csv::StringRecord>,
}

/// A line of it.
#[derive(Clone, Copy)]
pub struct Line<'a> {
    table: &'a Table,
    fields: &'a csv::StringRecord,
}

impl Table {
    /// Reads the file at `path`.
    ///
    /// # Errors
    /// [`TableError`], naming file and line.
    pub fn read(path: &Path) -> Result<Self, TableError> {
        let text = std::fs::read(path).map_err(|cause| TableError::Io {
            path: path.to_owned(),
            cause,
        })?;
        let broken = |error: csv::Error| TableError::Line {
            path: path.to_owned(),
            line: error.position().map_or(1, csv::Position::line),
            problem: error.to_string(),
        };
        let mut reader = csv::Reader::from_reader(&text[..]);
        let head: Vec<String> = reader.headers().map_err(broken)?.iter().map(str::to_owned).collect();
        Ok(Self {
            path: path.to_owned(),
            places: head.iter().cloned().zip(0..).collect(),
            lines: reader.records().collect::<Result<_, _>>().map_err(broken)?,
            head,
        })
    }

    /// Its lines.
    pub fn lines(&self) -> impl Iterator<Item = Line<'_>> {
        self.lines.iter().map(|fields| Line { table: self, fields })
    }
}

impl<'a> Line<'a> {
    /// What the column says; nothing where it is empty or left out.
    pub fn text(&self, column: &str) -> Option<&'a str> {
        let place = *self.table.places.get(column)?;
        self.fields.get(place).filter(|text| !text.is_empty())
    }

    /// What the column must say.
    ///
    /// # Errors
    /// [`TableError`] where it is empty or left out, or cannot be read.
    pub fn get<T: FromStr<Err: Display>>(&self, column: &str) -> Result<T, TableError> {
        self.maybe(column)?.ok_or_else(|| self.error(&format!("no `{column}`")))
    }

    /// What the column says, if it says something.
    ///
    /// # Errors
    /// [`TableError`] where it cannot be read.
    pub fn maybe<T: FromStr<Err: Display>>(&self, column: &str) -> Result<Option<T>, TableError> {
        let read = |text: &str| {
            text.parse()
                .map_err(|problem| self.error(&format!("`{column}` is `{text}`: {problem}")))
        };
        self.text(column).map(read).transpose()
    }

    /// What the column says, else that.
    ///
    /// # Errors
    /// [`TableError`] where it cannot be read.
    pub fn or<T: FromStr<Err: Display>>(&self, column: &str, default: T) -> Result<T, TableError> {
        Ok(self.maybe(column)?.unwrap_or(default))
    }

    /// A yes or no, written 1 or 0.
    ///
    /// # Errors
    /// [`TableError`] where it is something else.
    pub fn flag(&self, column: &str, default: bool) -> Result<bool, TableError> {
        match self.text(column) {
            None => Ok(default),
            Some("1") => Ok(true),
            Some("0") => Ok(false),
            Some(text) => Err(self.error(&format!("`{column}` is `{text}`, neither 0 nor 1"))),
        }
    }

    /// The columns that are called PREFIX…SUFFIX and say something: what stands for … in each name, and the number.
    ///
    /// # Errors
    /// [`TableError`] where one is no number.
    pub fn family(&self, prefix: &str, suffix: &str) -> Result<Vec<(&'a str, f64)>, TableError> {
        let mut found = Vec::new();
        for column in &self.table.head {
            let name = column.strip_prefix(prefix).and_then(|rest| rest.strip_suffix(suffix));
            if let Some(name) = name {
                found.extend(self.maybe(column)?.map(|value| (name, value)));
            }
        }
        Ok(found)
    }

    /// That something is wrong here.
    pub fn error(&self, problem: &str) -> TableError {
        TableError::Line {
            path: self.table.path.clone(),
            line: self.fields.position().map_or(0, csv::Position::line),
            problem: problem.into(),
        }
    }
}

/// A number at 9 significant digits, which is what tables hold of all that was measured.
pub fn number(value: f64) -> String {
    exact(format!("{value:.8e}").parse().unwrap_or(value))
}

/// A number at 3 significant digits: rounding and errors, of which only the size matters.
pub fn rough(value: f64) -> String {
    exact(format!("{value:.2e}").parse().unwrap_or(value))
}

/// A number to the last bit: what was asked for, so that it can be asked for again.
pub fn exact(value: f64) -> String {
    let text = format!("{value:?}");
    text.strip_suffix(".0").map(str::to_owned).unwrap_or(text)
}

/// 1 or 0.
pub fn flag(value: bool) -> String {
    u8::from(value).to_string()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn nine_digits_and_no_more() {
        for (value, text) in [
            (0.1 + 0.2, "0.3"),
            (1.0 / 3.0, "0.333333333"),
            (2.0 / 3.0 * 1e-7, "6.66666667e-8"),
            (123_456_789_012.0, "123456789000"),
            (90.0, "90"),
            (0.0, "0"),
            (1e300, "1e300"),
        ] {
            assert_eq!(number(value), text);
            assert!(((text.parse::<f64>().unwrap() - value) / value.max(1e-300)).abs() < 5e-9);
        }
        assert_eq!(exact(1.0 / 3.0).parse::<f64>().unwrap(), 1.0 / 3.0);
        assert_eq!(rough(2.0 / 3.0 * 1e-15), "6.67e-16");
    }

    fn pairs() -> Vec<Column<(u32, &'static str)>> {
        vec![
            Column::new("key", "", |line: &(u32, &str)| Some(line.0.to_string())),
            Column::new("text", "", |line: &(u32, &str)| Some(line.1.into())),
            Column::new("seed", "", |line: &(u32, &str)| Some((line.0 / 10).to_string())).or("0"),
            Column::new("never", "", |_: &(u32, &str)| None),
        ]
    }

    #[test]
    fn columns_that_say_nothing_are_left_out() {
        assert_eq!(write(&pairs(), &[(1, "a"), (2, "b")]), "key,text\n1,a\n2,b\n");
        assert_eq!(
            write(&pairs(), &[(1, "a"), (12, "b")]),
            "key,text,seed\n1,a,0\n12,b,1\n"
        );
        assert_eq!(write(&pairs(), &[]), "key\n");
    }

    #[test]
    fn what_is_written_is_read_and_what_is_wrong_is_told_with_its_line() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("table.csv");
        std::fs::write(&path, write(&pairs(), &[(1, "a, \"quoted\"\nand broken"), (12, "b")])).unwrap();
        let table = Table::read(&path).unwrap();
        let lines: Vec<Line> = table.lines().collect();
        assert_eq!(lines[0].text("text"), Some("a, \"quoted\"\nand broken"));
        assert_eq!(lines[1].get::<u32>("key").unwrap(), 12);
        assert_eq!(lines[1].or("never", 7).unwrap(), 7);
        assert_eq!(lines[1].family("s", "d").unwrap(), [("ee", 1.0)]);
        let told = lines[1].get::<u32>("text").unwrap_err().to_string();
        assert!(told.contains("table.csv:4: `text` is `b`"), "{told}");
        assert!(lines[1].flag("key", true).is_err() && lines[1].flag("never", true).unwrap());
        std::fs::write(&path, "key,text\n1,a\n2\n").unwrap();
        let told = Table::read(&path).err().unwrap().to_string();
        assert!(told.contains("table.csv:3"), "{told}");
        assert!(Table::read(&folder.path().join("none.csv")).is_err());
    }
}
