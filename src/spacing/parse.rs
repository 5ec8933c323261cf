//! SPEC: the text that names a spacing.
//!
//! ```text
//! SPEC = lfs | uniform:H | expr:EXPRESSION | min(SPEC, SPEC, …)
//! ```
//! Commas split `min` where no parenthesis of an expression is open.

use super::SpacingError;
use super::grammar;
use std::fmt;

/// The kinds of SPEC with their arguments, for messages and lists.
pub const KINDS: [&str; 4] = ["lfs", "uniform:H", "expr:EXPRESSION", "min(A, B)"];

/// A parsed SPEC; `Display` gives its canonical text.
#[derive(Clone, Debug, PartialEq)]
pub enum Spec {
    /// Local feature size (Definition 2.1).
    Lfs,
    /// f = H.
    Uniform(f64),
    /// f given by an expression in x and y.
    Expression(String),
    /// The smallest of several.
    Min(Vec<Spec>),
}

impl fmt::Display for Spec {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Lfs => out.write_str("lfs"),
            Self::Uniform(value) => write!(out, "uniform:{value}"),
            Self::Expression(text) => write!(out, "expr:{text}"),
            Self::Min(parts) => {
                let parts: Vec<String> = parts.iter().map(ToString::to_string).collect();
                write!(out, "min({})", parts.join(", "))
            }
        }
    }
}

impl Spec {
    /// Reads a SPEC.
    ///
    /// # Errors
    /// [`SpacingError::Parse`] with the column, [`SpacingError::UnknownKind`] with the kinds there are.
    pub fn parse(text: &str) -> Result<Self, SpacingError> {
        Reader { whole: text, open: 0 }.spec(0, text.len())
    }

    /// Whether the spacing is nowhere above lfs by its own definition.
    pub fn is_capped(&self) -> bool {
        match self {
            Self::Lfs => true,
            Self::Min(parts) => parts.iter().any(Self::is_capped),
            Self::Uniform(_) | Self::Expression(_) => false,
        }
    }
}

/// The SPEC whose edges are about as long as `expression` says: f = size / c_b.
///
/// # Errors
/// [`SpacingError::Parse`] where `expression` is none.
pub fn spec_for_size(expression: &str, c_b: f64) -> Result<String, SpacingError> {
    grammar::compile(expression).map_err(|source| SpacingError::Parse {
        spec: expression.into(),
        column: source.column,
        message: source.message,
    })?;
    Ok(format!("expr:({})/{c_b}", expression.trim()))
}

/// How deep `min` may nest: keeps the stack small, here and wherever a [`Spec`] is walked.
const NESTING: usize = 64;

struct Reader<'a> {
    whole: &'a str,
    /// How many `min(` are open.
    open: usize,
}

impl Reader<'_> {
    fn error(&self, at: usize, message: impl Into<String>) -> SpacingError {
        let column = self.whole[..at].chars().count() + 1;
        SpacingError::Parse {
            spec: self.whole.into(),
            column,
            message: message.into(),
        }
    }

    /// The SPEC between two byte offsets.
    fn spec(&mut self, from: usize, to: usize) -> Result<Spec, SpacingError> {
        let text = &self.whole[from..to];
        let from = from + text.len() - text.trim_start().len();
        let text = text.trim();
        if text == "lfs" {
            return Ok(Spec::Lfs);
        }
        if let Some(rest) = text.strip_prefix("uniform:") {
            let value: Option<f64> = rest
                .trim()
                .parse()
                .ok()
                .filter(|value: &f64| value.is_finite() && *value > 0.0);
            let message = "a positive number expected after `uniform:`";
            return value
                .map(Spec::Uniform)
                .ok_or_else(|| self.error(from + "uniform:".len(), message));
        }
        if let Some(rest) = text.strip_prefix("expr:") {
            let start = from + "expr:".len();
            return match grammar::compile(rest) {
                Ok(_) => Ok(Spec::Expression(rest.trim().into())),
                Err(source) => {
                    let offset = rest
                        .char_indices()
                        .nth(source.column - 1)
                        .map_or(rest.len(), |(byte, _)| byte);
                    Err(self.error(start + offset, source.message))
                }
            };
        }
        if let Some(rest) = text
            .strip_prefix("min")
            .map(str::trim_start)
            .filter(|rest| rest.starts_with('('))
        {
            if self.open == NESTING {
                return Err(self.error(from, "`min` is nested too deeply"));
            }
            self.open += 1;
            let spec = self.min(from + text.len() - rest.len() + 1, from + text.len());
            self.open -= 1;
            return spec;
        }
        Err(SpacingError::UnknownKind {
            kind: text.into(),
            known: KINDS.join(", "),
        })
    }

    /// The parts of a `min(` whose inside starts at `from`, up to the `)` that must end the text.
    fn min(&mut self, from: usize, to: usize) -> Result<Spec, SpacingError> {
        let mut parts = Vec::new();
        let mut start = from;
        let mut open = 0;
        for (at, symbol) in self.whole[from..to]
            .char_indices()
            .map(|(at, symbol)| (from + at, symbol))
        {
            match symbol {
                '(' => open += 1,
                ',' if open == 0 => {
                    parts.push(self.spec(start, at)?);
                    start = at + 1;
                }
                ')' if open == 0 && at + 1 < to => return Err(self.error(at + 1, "nothing expected after `min(…)`")),
                ')' if open == 0 => {
                    parts.push(self.spec(start, at)?);
                    let enough = parts.len() > 1;
                    return if enough {
                        Ok(Spec::Min(parts))
                    } else {
                        Err(self.error(at, "`min` takes two or more"))
                    };
                }
                ')' => open -= 1,
                _ => {}
            }
        }
        Err(self.error(to, "`)` expected to end `min(`"))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_kind_reads_back_as_it_is_written() {
        for (text, canonical) in [
            ("lfs", "lfs"),
            (" uniform: 0.10 ", "uniform:0.1"),
            ("expr: 0.1+min(x, y) ", "expr:0.1+min(x, y)"),
            ("min( lfs,uniform:2)", "min(lfs, uniform:2)"),
            (
                "min(lfs, expr:min(x,y), min(lfs,uniform:1))",
                "min(lfs, expr:min(x,y), min(lfs, uniform:1))",
            ),
        ] {
            let spec = Spec::parse(text).unwrap();
            assert_eq!(spec.to_string(), canonical);
            assert_eq!(Spec::parse(canonical).unwrap(), spec);
        }
    }

    #[test]
    fn errors_say_the_column_or_the_kinds() {
        let error = |text: &str| Spec::parse(text).unwrap_err().to_string();
        assert_eq!(
            error("uniform:-1"),
            "spacing `uniform:-1`, column 9: a positive number expected after `uniform:`"
        );
        assert_eq!(
            error("min(lfs, expr:x+*y)"),
            "spacing `min(lfs, expr:x+*y)`, column 17: a number, x, y or a function expected, found `*`"
        );
        assert_eq!(
            error("hessian:x^2"),
            "spacing `hessian:x^2` is unknown; there are lfs, uniform:H, expr:EXPRESSION, min(A, B)"
        );
        assert!(error("min(lfs, lfs").ends_with("column 13: `)` expected to end `min(`"));
        assert!(error("min(lfs)").ends_with("column 8: `min` takes two or more"));
        assert!(error("min(lfs, lfs) + 1").ends_with("column 14: nothing expected after `min(…)`"));
    }

    #[test]
    fn min_in_min_without_end_does_not_overflow_the_stack() {
        let nested = |depth: usize| format!("{}lfs{}", "min(lfs,".repeat(depth), ")".repeat(depth));
        assert!(Spec::parse(&nested(NESTING)).is_ok());
        for depth in [NESTING + 1, 100_000] {
            let error = Spec::parse(&nested(depth)).unwrap_err().to_string();
            assert!(error.ends_with("column 513: `min` is nested too deeply"));
        }
    }

    #[test]
    fn min_may_have_any_number_of_mins_beside_one_another() {
        let many = format!("min({})", vec!["min(lfs, lfs)"; 10 * NESTING].join(", "));
        assert!(matches!(Spec::parse(&many), Ok(Spec::Min(parts)) if parts.len() == 10 * NESTING));
        assert!(Spec::parse(&format!("min(lfs, {many})")).is_ok());
    }

    #[test]
    fn a_size_is_divided_by_c_b() {
        assert_eq!(spec_for_size(" 0.1+x ", 0.5).unwrap(), "expr:(0.1+x)/0.5");
        let error = spec_for_size("0.1+", 0.5).unwrap_err().to_string();
        assert_eq!(
            error,
            "spacing `0.1+`, column 5: a number, x, y or a function expected, found the end"
        );
    }

    #[test]
    fn columns_count_characters_from_the_start_of_the_whole() {
        let error = |text: &str| Spec::parse(text).unwrap_err().to_string();
        for (text, column, message) in [
            ("  uniform:0", 11, "a positive number expected after `uniform:`"),
            ("uniform:inf", 9, "a positive number expected after `uniform:`"),
            ("uniform:nan", 9, "a positive number expected after `uniform:`"),
            ("uniform:", 9, "a positive number expected after `uniform:`"),
            ("expr:x+*y", 8, "a number, x, y or a function expected, found `*`"),
            (" expr: 1+", 10, "a number, x, y or a function expected, found the end"),
            ("min(lfs, uniform:x)", 18, "a positive number expected after `uniform:`"),
            ("min(expr:x §, lfs)", 12, "`§` has no meaning here"),
            ("min (lfs)", 9, "`min` takes two or more"),
            ("min(lfs, min(lfs))", 17, "`min` takes two or more"),
            ("min(lfs, lfs) ;", 14, "nothing expected after `min(…)`"),
            (" min(lfs, lfs", 14, "`)` expected to end `min(`"),
            ("min(lfs, expr:(x)", 18, "`)` expected to end `min(`"),
        ] {
            assert_eq!(error(text), format!("spacing `{text}`, column {column}: {message}"));
        }
        for (text, kind) in [
            ("", ""),
            ("min", "min"),
            ("min(lfs,, lfs)", ""),
            ("min(lfs, LFS)", "LFS"),
            ("minimum(lfs, lfs)", "minimum(lfs, lfs)"),
        ] {
            let told = Spec::parse(text).unwrap_err();
            assert!(
                matches!(&told, SpacingError::UnknownKind { kind: found, .. } if found == kind),
                "{text}: {told}"
            );
        }
    }

    #[test]
    fn a_spec_is_capped_where_lfs_is_a_part_of_it() {
        for (text, is_capped) in [
            ("lfs", true),
            ("uniform:1", false),
            ("expr:x", false),
            ("min(uniform:1, expr:x)", false),
            ("min(uniform:1, lfs)", true),
            ("min(uniform:1, min(expr:x, lfs))", true),
        ] {
            assert_eq!(Spec::parse(text).unwrap().is_capped(), is_capped, "{text}");
        }
    }

    #[test]
    fn commas_and_parentheses_of_expressions_are_their_own() {
        let spec = Spec::parse(" min ( expr:max(x, (y)), min(lfs, uniform:2 ) , expr:(x)*(y) )").unwrap();
        let expression = |text: &str| Spec::Expression(text.to_owned());
        let inner = Spec::Min(vec![Spec::Lfs, Spec::Uniform(2.0)]);
        assert_eq!(
            spec,
            Spec::Min(vec![expression("max(x, (y))"), inner, expression("(x)*(y)")])
        );
    }
}
