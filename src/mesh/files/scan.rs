//! Reads words and numbers from text, knowing the line they stand on.

use std::str::FromStr;

/// What is wrong with a text, and where.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Complaint {
    /// Line, counted from 1.
    pub line: usize,
    /// What is wrong.
    pub message: String,
}

/// The words of a text, one after the other over line ends.
#[derive(Clone)]
pub struct Words<'a> {
    rest: &'a str,
    line: usize,
    /// Whether `#` starts a comment that ends with the line.
    comments: bool,
}

impl<'a> Words<'a> {
    /// Starts at the beginning of `text`, which is line `line` of its file.
    pub fn new(text: &'a str, line: usize, comments: bool) -> Self {
        Self {
            rest: text,
            line,
            comments,
        }
    }

    /// The next word, on whichever line it is.
    pub fn next(&mut self) -> Option<&'a str> {
        loop {
            let start = self.rest.find(|c: char| c == '\n' || !c.is_ascii_whitespace())?;
            self.rest = &self.rest[start..];
            if let Some(rest) = self.rest.strip_prefix('\n') {
                self.line += 1;
                self.rest = rest;
            } else if self.comments && self.rest.starts_with('#') {
                self.rest = &self.rest[self.rest.find('\n').unwrap_or(self.rest.len())..];
            } else {
                let end = |c: char| c.is_ascii_whitespace() || (self.comments && c == '#');
                let (word, rest) = self.rest.split_at(self.rest.find(end).unwrap_or(self.rest.len()));
                self.rest = rest;
                return Some(word);
            }
        }
    }

    /// The words left on this line, which is thereby read.
    pub fn finish_line(&mut self) -> impl Iterator<Item = &'a str> + use<'a> {
        let (line, rest) = self.rest.split_at(self.rest.find('\n').unwrap_or(self.rest.len()));
        self.rest = rest;
        let line = if self.comments {
            line.split('#').next().unwrap_or("")
        } else {
            line
        };
        line.split_ascii_whitespace()
    }

    /// Skips the rest of this line.
    pub fn skip_line(&mut self) {
        self.rest = &self.rest[self.rest.find('\n').unwrap_or(self.rest.len())..];
    }

    /// The next word as a number; `what` names it in the complaint.
    pub fn number<T: FromStr>(&mut self, what: &str) -> Result<T, Complaint> {
        match self.next() {
            Some(word) => parse(word).ok_or_else(|| self.complain(format!("expected {what}, found `{word}`"))),
            None => Err(self.complain(format!("expected {what}, but the file ends"))),
        }
    }

    /// The next word as a finite number.
    pub fn coordinate(&mut self) -> Result<f64, Complaint> {
        let value: f64 = self.number("coordinate")?;
        if value.is_finite() {
            Ok(value)
        } else {
            Err(self.complain(format!("coordinate {value} is not finite")))
        }
    }

    /// The next word as the index of one of `count` things, counted from `base`; returned counted from 0.
    pub fn index(&mut self, what: &str, base: i64, count: usize) -> Result<u32, Complaint> {
        let index: i64 = self.number(what)?;
        let counted = index.checked_sub(base).and_then(|k| u32::try_from(k).ok());
        counted
            .filter(|k| (*k as usize) < count)
            .ok_or_else(|| self.complain(format!("there is no {what} {index}")))
    }

    /// A complaint about the last word.
    pub fn complain(&self, message: impl Into<String>) -> Complaint {
        Complaint {
            line: self.line,
            message: message.into(),
        }
    }
}

/// The word as a number, if it is one.
pub fn parse<T: FromStr>(word: &str) -> Option<T> {
    word.parse().ok()
}
