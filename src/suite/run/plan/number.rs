//! Numbers of a plan.

use serde::Deserialize;

/// A number, or a fraction in quotes, since TOML cannot write 1/3.
#[derive(Clone, Copy, Debug, PartialEq, Deserialize)]
#[serde(try_from = "Written")]
pub struct Number(f64);

impl Number {
    /// Its value, positive and finite.
    pub fn get(self) -> f64 {
        self.0
    }
}

#[derive(Deserialize)]
#[serde(untagged)]
enum Written {
    Number(f64),
    Text(String),
}

impl TryFrom<Written> for Number {
    type Error = String;

    fn try_from(written: Written) -> Result<Self, String> {
        let value = match written {
            Written::Number(value) => value,
            Written::Text(text) => fraction(&text).ok_or_else(|| format!("`{text}` is no number such as \"1/3\""))?,
        };
        if value.is_finite() && value > 0.0 {
            Ok(Self(value))
        } else {
            Err(format!("{value} must be positive and finite"))
        }
    }
}

/// `"1/3"` or `"0.25"` as a number.
pub fn fraction(text: &str) -> Option<f64> {
    match text.split_once('/') {
        Some((over, under)) => Some(over.trim().parse::<f64>().ok()? / under.trim().parse::<f64>().ok()?),
        None => text.trim().parse().ok(),
    }
}
