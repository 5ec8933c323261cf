//! Tables and numbers as Markdown.

use crate::suite::analysis::measures::Measure;
use crate::suite::analysis::summary::rounded;
use crate::suite::rows::numbers::Spread;

/// `value` with three digits that count, `–` where there is none.
pub(crate) fn number(value: impl Into<Option<f64>>) -> String {
    match value.into() {
        Some(0.0) => "0".into(),
        Some(value) if value.is_finite() => {
            let size = value.abs().max(1e-12).log10().floor() as i32;
            if size < -3 {
                return format!("{value:.2e}");
            }
            format!("{value:.*}", (2 - size).clamp(0, 4) as usize)
        }
        _ => "–".into(),
    }
}

/// `value` with two decimals, as angles are told; `–` where there is none.
pub(super) fn degrees(value: impl Into<Option<f64>>) -> String {
    match value.into() {
        Some(value) if value.is_finite() => format!("{value:.2}°"),
        _ => "–".into(),
    }
}

/// A value of a measure, without its unit.
pub(super) fn value(measure: &Measure, value: impl Into<Option<f64>>) -> String {
    match (measure.decimals, value.into().filter(|value| value.is_finite())) {
        (Some(decimals), Some(value)) => format!("{value:.decimals$}"),
        (_, value) => number(value),
    }
}

/// A value of a measure with its unit.
pub(super) fn told(measure: &Measure, value: impl Into<Option<f64>>) -> String {
    let blank = if matches!(measure.unit, "" | "°") { "" } else { " " };
    format!("{}{blank}{}", self::value(measure, value), measure.unit)
}

/// From the least to the most of some numbers.
pub(super) fn range(spread: &Spread) -> String {
    let [least, most] = [spread.least, spread.most].map(number);
    if least == most {
        least
    } else {
        format!("{least} to {most}")
    }
}

/// A number with its sign.
pub(super) fn signed(value: impl Into<Option<f64>>) -> String {
    match value.into() {
        Some(value) if value > 0.0 => format!("+{}", number(value)),
        other => number(other),
    }
}

/// A share as a percentage with three digits that count.
pub(super) fn percent(share: impl Into<Option<f64>>) -> String {
    share
        .into()
        .map_or_else(|| "–".into(), |share| format!("{} %", number(100.0 * share)))
}

/// A parameter such as t or c_b, without the noise of its last digits.
pub(super) fn parameter(value: f64) -> String {
    rounded(value).to_string()
}

/// Text that may hold what Markdown would take for its own.
pub(super) fn plain(text: &str) -> String {
    text.replace('|', "\\|").replace('\n', " ")
}

/// A table; every line has as many cells as `head`. Columns of numbers are set to the right.
pub(crate) fn table(head: &[&str], lines: &[Vec<String>]) -> String {
    let row = |cells: Vec<String>| format!("| {} |\n", cells.join(" | "));
    let numeric =
        |text: &String| text.is_empty() || text.starts_with(|c: char| c.is_ascii_digit() || "–-(*".contains(c));
    let rule = (0..head.len()).map(|k| {
        if lines.iter().all(|line| numeric(&line[k])) {
            "---:"
        } else {
            "---"
        }
    });
    let mut text = row(head.iter().map(|cell| plain(cell)).collect());
    text += &row(rule.map(str::to_string).collect());
    for line in lines {
        text += &row(line.iter().map(|cell| plain(cell)).collect());
    }
    text + "\n"
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_have_digits_that_count() {
        assert_eq!(number(1234.4), "1234");
        assert_eq!(number(12.345), "12.3");
        assert_eq!(number(0.012345), "0.0123");
        assert_eq!(number(0.00001234), "1.23e-5");
        assert_eq!(number(0.0), "0");
        assert_eq!(number(None), "–");
        assert_eq!(number(f64::NAN), "–");
        assert_eq!(degrees(29.999), "30.00°");
        assert_eq!(parameter(1.0 / 3.0), "0.3333");
    }

    #[test]
    fn a_table_keeps_its_columns() {
        let text = table(&["a", "b"], &[vec!["x|y".into(), "1".into()]]);
        assert_eq!(text, "| a | b |\n| --- | ---: |\n| x\\|y | 1 |\n\n");
    }
}
