//! Quantiles, spreads, fitted lines, and the different values of some.

/// The `q`-quantile of `values` (0 ≤ q ≤ 1), linear between neighbours; absent for no values. NaN sorts last.
pub fn quantile(mut values: Vec<f64>, q: f64) -> Option<f64> {
    values.sort_by(f64::total_cmp);
    let last = values.len().checked_sub(1)?;
    let place = q.clamp(0.0, 1.0) * last as f64;
    let below = values[place.floor() as usize];
    let above = values[place.ceil() as usize];
    Some(below + (above - below) * place.fract())
}

/// The middle value, the mean of the two middle ones for an even count; absent for no values.
pub fn median(values: Vec<f64>) -> Option<f64> {
    quantile(values, 0.5)
}

/// Least, middle and most of some numbers.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Spread {
    /// How many there are.
    pub count: usize,
    /// The least of them.
    pub least: f64,
    /// Their median.
    pub median: f64,
    /// The most.
    pub most: f64,
}

/// The spread of `values`; absent for none.
pub fn spread(values: Vec<f64>) -> Option<Spread> {
    Some(Spread {
        count: values.len(),
        least: quantile(values.clone(), 0.0)?,
        most: quantile(values.clone(), 1.0)?,
        median: median(values)?,
    })
}

/// y = slope · x + intercept.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Line {
    /// dy / dx.
    pub slope: f64,
    /// y at x = 0.
    pub intercept: f64,
}

/// The least-squares line through `points`; absent unless two of them differ in x.
pub fn fit_line(points: &[(f64, f64)]) -> Option<Line> {
    let count = points.len() as f64;
    let mean_x = points.iter().map(|p| p.0).sum::<f64>() / count;
    let mean_y = points.iter().map(|p| p.1).sum::<f64>() / count;
    let spread: f64 = points.iter().map(|p| (p.0 - mean_x).powi(2)).sum();
    let shared: f64 = points.iter().map(|p| (p.0 - mean_x) * (p.1 - mean_y)).sum();
    (spread > 0.0).then(|| Line {
        slope: shared / spread,
        intercept: mean_y - shared / spread * mean_x,
    })
}

/// The different values of `values`, ascending.
pub fn distinct(values: impl Iterator<Item = f64>) -> Vec<f64> {
    let mut all: Vec<f64> = values.collect();
    all.sort_by(f64::total_cmp);
    all.dedup();
    all
}

/// The different texts of `texts`, in the order in which they first appear.
pub fn first_seen<'a>(texts: impl Iterator<Item = &'a str>) -> Vec<&'a str> {
    let mut seen = Vec::new();
    for text in texts {
        if !seen.contains(&text) {
            seen.push(text);
        }
    }
    seen
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn quantiles_by_hand() {
        assert_eq!(median(vec![]), None);
        assert_eq!(median(vec![3.0, 1.0, 2.0]), Some(2.0));
        assert_eq!(median(vec![4.0, 1.0, 2.0, 3.0]), Some(2.5));
        assert_eq!(quantile(vec![10.0, 0.0], 0.25), Some(2.5));
        assert_eq!(quantile(vec![10.0, 0.0], 7.0), Some(10.0));
    }

    #[test]
    fn a_line_by_hand() {
        // Residuals of (0,0), (1,3), (2,3) against 1.5 x + 0.5 are −0.5, 1, −0.5: they sum to 0 and are orthogonal to x.
        let line = fit_line(&[(0.0, 0.0), (1.0, 3.0), (2.0, 3.0)]).unwrap();
        assert_eq!(
            line,
            Line {
                slope: 1.5,
                intercept: 0.5
            }
        );
        assert_eq!(fit_line(&[(1.0, 0.0), (1.0, 3.0)]), None);
        assert_eq!(fit_line(&[]), None);
    }

    #[test]
    fn distinct_values_and_texts() {
        assert_eq!(distinct([0.5, 0.1, 0.5].into_iter()), [0.1, 0.5]);
        assert_eq!(first_seen(["b", "a", "b"].into_iter()), ["b", "a"]);
    }
}
