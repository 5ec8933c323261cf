//! How values are written on the command line.

use crate::meshers::{Budget, parameter_value};
use crate::suite::run::plan::fraction;
use serde_json::Value;

/// Budgets, as `mesh` and `adapt` take them.
#[derive(clap::Args)]
pub struct Limits {
    /// Most vertices a mesh may have
    #[arg(long, value_name = "N")]
    max_vertices: Option<usize>,
    /// Most seconds the mesher may take, and as many for domain, spacing and certificate each
    #[arg(long, value_name = "SECONDS", value_parser = positive)]
    max_seconds: Option<f64>,
    /// Most memory of the process, such as 4G
    #[arg(long, value_name = "BYTES", value_parser = bytes)]
    max_memory: Option<u64>,
}

impl Limits {
    pub fn budget(&self) -> Budget {
        Budget {
            max_vertices: self.max_vertices,
            max_seconds: self.max_seconds,
            max_memory: self.max_memory,
        }
    }
}

/// A positive number, also as a fraction: `0.25`, `1/3`.
pub fn positive(text: &str) -> Result<f64, String> {
    match fraction(text) {
        Some(value) if value.is_finite() && value > 0.0 => Ok(value),
        _ => Err("write a positive number or a fraction, such as 0.25 or 1/3".into()),
    }
}

/// A number between 0 and 1.
pub fn share(text: &str) -> Result<f64, String> {
    match fraction(text) {
        Some(value) if 0.0 < value && value < 1.0 => Ok(value),
        _ => Err("write a number between 0 and 1, such as 0.05".into()),
    }
}

/// A number of bytes: `500M`, `4G`, `1000000`.
pub fn bytes(text: &str) -> Result<u64, String> {
    let lower = text.trim().to_ascii_lowercase();
    let number = lower.trim_end_matches('b');
    let (digits, unit) = match number.char_indices().last() {
        Some((at, 'k')) => (&number[..at], 1e3),
        Some((at, 'm')) => (&number[..at], 1e6),
        Some((at, 'g')) => (&number[..at], 1e9),
        Some((at, 't')) => (&number[..at], 1e12),
        _ => (number, 1.0),
    };
    match digits.trim().parse::<f64>() {
        Ok(value) if value.is_finite() && value > 0.0 => Ok((value * unit) as u64),
        _ => Err("write a number of bytes, such as 500M or 4G".into()),
    }
}

/// `name=value`, the value as JSON where it is some, else as text.
pub fn parameter(text: &str) -> Result<(String, Value), String> {
    let (name, value) = text
        .split_once('=')
        .ok_or("write it as name=value; `biting list` shows the parameters")?;
    Ok((name.trim().into(), parameter_value(value)))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_fractions_and_bytes() {
        assert_eq!(positive("1/4"), Ok(0.25));
        assert_eq!(positive(" 2 "), Ok(2.0));
        for bad in ["0", "-1", "1/0", "nan", "a", "1/-2", ""] {
            assert!(positive(bad).is_err(), "{bad}");
        }
        assert_eq!(share("1/20"), Ok(0.05));
        for bad in ["0", "1", "2", "-0.1", "nan"] {
            assert!(share(bad).is_err(), "{bad}");
        }
        assert_eq!(bytes("4G"), Ok(4_000_000_000));
        assert_eq!(bytes("1.5 kB"), Ok(1500));
        assert_eq!(bytes("17"), Ok(17));
        for bad in ["", "G", "-1M", "4X"] {
            assert!(bytes(bad).is_err(), "{bad}");
        }
    }

    #[test]
    fn parameters_are_json_or_text() {
        assert_eq!(parameter("order=fifo"), Ok(("order".into(), Value::from("fifo"))));
        assert_eq!(parameter("factor=2.5"), Ok(("factor".into(), Value::from(2.5))));
        assert_eq!(parameter("on=true"), Ok(("on".into(), Value::from(true))));
        assert!(parameter("order").is_err());
    }
}
