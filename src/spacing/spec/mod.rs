//! SPEC: the text that names a spacing.
//!
//! ```text
//! SPEC = lfs | lfs:geodesic | uniform:H | expr:EXPRESSION | hessian:EXPRESSION;eps=E[;min=A][;max=B]
//!      | field:FILE;eps=E[;min=A][;max=B] | points:FILE[;factor=K][;alpha=A] | el:FILE[;factor=K] | nn:FILE[;factor=K]
//!      | min(SPEC, SPEC, …)
//! ```
//! Commas split `min` outside the parentheses of an expression; a file's name has no commas, semicolons or parentheses.
//! `lfs:geodesic` stands alone or in a `min` without `lfs`, which it is nowhere below.

pub(super) mod ingredients;
mod settings;

use crate::spacing::SpacingError;
use crate::spacing::expression::grammar;
use crate::spacing::expression::hessian::Tolerance;
use std::fmt;

/// The kinds of SPEC with their arguments, for messages and lists.
pub const KINDS: [&str; 10] = [
    "lfs",
    "lfs:geodesic",
    "uniform:H",
    "expr:EXPRESSION",
    "hessian:EXPRESSION;eps=E",
    "field:FILE;eps=E",
    "points:FILE",
    "el:FILE",
    "nn:FILE",
    "min(A, B)",
];

/// A parsed SPEC; `Display` gives its canonical text.
#[derive(Clone, Debug, PartialEq)]
pub enum Spec {
    /// Local feature size (Definition 2.1).
    Lfs,
    /// Local feature size by distances inside the domain (the footnote of Definition 2.1).
    GeodesicLfs,
    /// f = H.
    Uniform(f64),
    /// f given by an expression in x and y.
    Expression(String),
    /// nsf of §2.2 for u given by an expression.
    Hessian(String, Tolerance),
    /// nsf of §2.2 for u given at the vertices of the mesh in a file.
    Field(String, Tolerance),
    /// The envelope of §2.3 of sizes at points.
    Points {
        /// The file that has them.
        file: String,
        /// What they are multiplied by.
        factor: Option<f64>,
        /// How much f may grow away from them, per unit of distance.
        alpha: Option<f64>,
    },
    /// el_M of §2.1 for the mesh in a file, times a factor if there is one.
    EdgeLength(String, Option<f64>),
    /// nn_M of §2.1 for the mesh in a file, times a factor if there is one.
    NearestNeighbour(String, Option<f64>),
    /// The smallest of several.
    Min(Vec<Spec>),
}

impl fmt::Display for Spec {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Lfs => out.write_str("lfs"),
            Self::GeodesicLfs => out.write_str("lfs:geodesic"),
            Self::Uniform(value) => write!(out, "uniform:{value}"),
            Self::Expression(text) => write!(out, "expr:{text}"),
            Self::Hessian(text, tolerance) => write!(out, "hessian:{text}{}", tolerance_text(tolerance)),
            Self::Field(file, tolerance) => write!(out, "field:{file}{}", tolerance_text(tolerance)),
            Self::Points { file, factor, alpha } => {
                let given = settings::text(&[("factor", *factor), ("alpha", *alpha)]);
                write!(out, "points:{file}{given}")
            }
            Self::EdgeLength(file, factor) => write!(out, "el:{file}{}", settings::text(&[("factor", *factor)])),
            Self::NearestNeighbour(file, factor) => write!(out, "nn:{file}{}", settings::text(&[("factor", *factor)])),
            Self::Min(parts) => {
                let parts: Vec<String> = parts.iter().map(ToString::to_string).collect();
                write!(out, "min({})", parts.join(", "))
            }
        }
    }
}

fn tolerance_text(tolerance: &Tolerance) -> String {
    settings::text(&[
        ("eps", Some(tolerance.eps)),
        ("min", tolerance.min),
        ("max", tolerance.max),
    ])
}

impl Spec {
    /// Reads a SPEC.
    ///
    /// # Errors
    /// [`SpacingError::Parse`] with the column, [`SpacingError::UnknownKind`] with the kinds there are.
    pub fn parse(text: &str) -> Result<Self, SpacingError> {
        let reader = &mut Reader { whole: text, open: 0 };
        let spec = reader.spec(0, text.len())?;
        if spec.is_geodesic() && spec.is_euclidean_lfs() {
            let at = text.find("lfs:geodesic").unwrap_or_default();
            return Err(reader.error(at, "lfs:geodesic is nowhere below lfs; leave one of them out"));
        }
        Ok(spec)
    }

    /// Whether the spacing is nowhere above lfs by its own definition.
    pub fn is_capped(&self) -> bool {
        match self {
            Self::Lfs | Self::GeodesicLfs => true,
            Self::Min(parts) => parts.iter().any(Self::is_capped),
            Self::Uniform(_) | Self::Expression(_) | Self::Hessian(..) => false,
            Self::Field(..) | Self::Points { .. } | Self::EdgeLength(..) | Self::NearestNeighbour(..) => false,
        }
    }

    /// Whether distances are measured inside the domain.
    pub fn is_geodesic(&self) -> bool {
        match self {
            Self::GeodesicLfs => true,
            Self::Min(parts) => parts.iter().any(Self::is_geodesic),
            _ => false,
        }
    }

    /// Whether the lfs of the plane is part of it.
    fn is_euclidean_lfs(&self) -> bool {
        match self {
            Self::Lfs => true,
            Self::Min(parts) => parts.iter().any(Self::is_euclidean_lfs),
            _ => false,
        }
    }
}

/// The SPEC whose edges are about as long as `expression` says: f = size / c_b.
///
/// # Errors
/// [`SpacingError::Parse`] if `expression` is not an expression.
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
        match text {
            "lfs" => return Ok(Spec::Lfs),
            "lfs:geodesic" => return Ok(Spec::GeodesicLfs),
            _ => {}
        }
        if let Some((kind, rest)) = text.split_once(':')
            && let Some(spec) = self.with_argument(kind, rest, from + kind.len() + 1)?
        {
            return Ok(spec);
        }
        if text.starts_with("gns:") {
            // This kind existed once, and scripts may still use it.
            return Err(self.error(
                from,
                "write SPEC in place of gns:SPEC, since every spacing is capped by lfs; where that cap is lifted, min(lfs, SPEC)",
            ));
        }
        if let Some(rest) = text
            .strip_prefix("min")
            .map(str::trim_start)
            .filter(|rest| rest.starts_with('('))
        {
            let inside = from + text.len() - rest.len() + 1;
            return self.nested(from, |reader| reader.min(inside, from + text.len()));
        }
        Err(SpacingError::UnknownKind {
            kind: text.into(),
            known: KINDS.join(", "),
        })
    }

    /// A SPEC of a kind that takes one argument, perhaps with settings, which starts at `start`; none of another kind.
    fn with_argument(&self, kind: &str, rest: &str, start: usize) -> Result<Option<Spec>, SpacingError> {
        Ok(Some(match kind {
            "uniform" => {
                let value: Option<f64> = rest.trim().parse().ok();
                let value = value.filter(|value| value.is_finite() && *value > 0.0);
                let message = "a positive number expected after `uniform:`";
                Spec::Uniform(value.ok_or_else(|| self.error(start, message))?)
            }
            "expr" => {
                self.compiles(rest, start)?;
                Spec::Expression(rest.trim().into())
            }
            "hessian" => {
                let (solution, tolerance) = self.tolerance(rest, start)?;
                self.compiles(solution, start)?;
                Spec::Hessian(solution.trim().into(), tolerance)
            }
            "field" => {
                let (file, tolerance) = self.tolerance(rest, start)?;
                Spec::Field(self.file(file, start)?, tolerance)
            }
            "points" => {
                let (file, [factor, alpha]) = self.settings(rest, start, ["factor", "alpha"])?;
                let file = self.file(file, start)?;
                Spec::Points { file, factor, alpha }
            }
            "el" | "nn" => {
                let (file, [factor]) = self.settings(rest, start, ["factor"])?;
                let file = self.file(file, start)?;
                match kind {
                    "el" => Spec::EdgeLength(file, factor),
                    _ => Spec::NearestNeighbour(file, factor),
                }
            }
            _ => return Ok(None),
        }))
    }

    /// What `read` finds one level deeper, for the `min` that stands at `from`.
    fn nested(
        &mut self,
        from: usize,
        read: impl FnOnce(&mut Self) -> Result<Spec, SpacingError>,
    ) -> Result<Spec, SpacingError> {
        if self.open == NESTING {
            return Err(self.error(from, "`min` is nested too deeply"));
        }
        self.open += 1;
        let spec = read(self);
        self.open -= 1;
        spec
    }

    /// Refuses `text`, which starts at `start`, if it is not an expression.
    fn compiles(&self, text: &str, start: usize) -> Result<(), SpacingError> {
        let Err(source) = grammar::compile(text) else {
            return Ok(());
        };
        let place = text.char_indices().nth(source.column - 1);
        let offset = place.map_or(text.len(), |(byte, _)| byte);
        Err(self.error(start + offset, source.message))
    }

    /// Splits `ARGUMENT;name=value;…`, which starts at `start`.
    fn settings<'t, const N: usize>(
        &self,
        text: &'t str,
        start: usize,
        names: [&str; N],
    ) -> Result<(&'t str, [settings::Value; N]), SpacingError> {
        settings::read(text, names).map_err(|(at, message)| self.error(start + at, message))
    }

    /// A file's name, which starts at `start`.
    fn file(&self, text: &str, start: usize) -> Result<String, SpacingError> {
        let name = text.trim();
        if name.is_empty() {
            return Err(self.error(start, "a file expected"));
        }
        Ok(name.to_owned())
    }

    /// Splits `ARGUMENT;eps=E;min=A;max=B`, which starts at `start`.
    fn tolerance<'t>(&self, text: &'t str, start: usize) -> Result<(&'t str, Tolerance), SpacingError> {
        let (argument, [eps, min, max]) = self.settings(text, start, ["eps", "min", "max"])?;
        let eps = eps.ok_or_else(|| {
            let message = "`;eps=E` expected: the error of linear interpolation that is allowed, in the unit of u";
            self.error(start + text.len(), message)
        })?;
        match (min, max) {
            (Some(low), Some(high)) if low > high => {
                Err(self.error(start + argument.len(), format!("min = {low} is above max = {high}")))
            }
            _ => Ok((argument, Tolerance { eps, min, max })),
        }
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
mod tests;
