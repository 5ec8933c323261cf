//! Work over ranges in parallel, with results in order, so that what is folded from them does not depend on the
//! threads.

use rayon::prelude::*;
use std::ops::Range;

/// Items per task: enough to hide the cost of a task, few enough to share out.
const CHUNK: usize = 2048;

/// Runs `work` on consecutive ranges that make up 0..count, and returns the results in order.
pub fn map_ranges<T: Send>(count: usize, work: impl Fn(Range<usize>) -> T + Sync) -> Vec<T> {
    let ranges = count.div_ceil(CHUNK);
    (0..ranges)
        .into_par_iter()
        .map(|k| work(k * CHUNK..((k + 1) * CHUNK).min(count)))
        .collect()
}

/// `value` of each of 0..count, in order.
pub fn map<T: Send>(count: usize, value: impl Fn(usize) -> T + Sync + Send) -> Vec<T> {
    (0..count).into_par_iter().with_min_len(CHUNK).map(value).collect()
}

/// The sum of `value` over 0..count, added in a fixed order.
pub fn sum(count: usize, value: impl Fn(usize) -> f64 + Sync) -> f64 {
    map_ranges(count, |range| range.map(&value).sum::<f64>())
        .into_iter()
        .sum()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ranges_make_up_the_whole_in_order_and_are_small_enough_to_share_out() {
        for count in [0, 1, CHUNK - 1, CHUNK, CHUNK + 1, 3 * CHUNK + 5] {
            let ranges = map_ranges(count, |range| range);
            assert!(ranges.iter().all(|range| !range.is_empty() && range.len() <= CHUNK));
            let expected: Vec<usize> = (0..count).collect();
            assert_eq!(ranges.into_iter().flatten().collect::<Vec<_>>(), expected);
            assert_eq!(map(count, |k| k), expected);
            assert_eq!(sum(count, |k| k as f64), expected.iter().sum::<usize>() as f64);
        }
    }
}
