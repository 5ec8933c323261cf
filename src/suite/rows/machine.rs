//! What the machine tells of itself: provenance of a row, peak memory, memory left. Linux tells most, others less.

use crate::suite::rows::record::Provenance;
use std::process::Command;
use std::time::{SystemTime, UNIX_EPOCH};

/// Version, commit, compiler and machine of this process, dated now. What cannot be learnt stays empty.
pub fn provenance() -> Provenance {
    let commit = git(&["rev-parse", "HEAD"]).unwrap_or_default();
    // Results and their findings in the README are what a run writes, so they do not make a work tree dirty.
    let written = [".", ":!results", ":!README.md"];
    let status = ["status", "--porcelain", "--untracked-files=no", "--"];
    let changes = git(&[&status[..], &written].concat()).unwrap_or_default();
    Provenance {
        version: env!("CARGO_PKG_VERSION").into(),
        dirty: !changes.is_empty(),
        commit,
        rustc: env!("BITING_RUSTC").into(),
        cpu: cpu(),
        cores: std::thread::available_parallelism().map_or(1, usize::from),
        os: os(),
        date: now(),
    }
}

/// The time, RFC 3339, UTC.
pub fn now() -> String {
    rfc3339(
        SystemTime::now()
            .duration_since(UNIX_EPOCH)
            .map_or(0, |since| since.as_secs()),
    )
}

/// Whether two rows were made on machines that look alike, so that their times may stand in one table.
pub fn same_machine(first: &Provenance, second: &Provenance) -> bool {
    (&first.cpu, first.cores, &first.os) == (&second.cpu, second.cores, &second.os)
}

/// Peak resident memory of this process in bytes, 0 where the system does not tell.
pub fn peak_rss_bytes() -> u64 {
    kilobytes_in("/proc/self/status", "VmHWM:").unwrap_or(0)
}

/// Makes [`peak_rss_bytes`] count from now on, where the system can do that (Linux), so that a cell which runs alone
/// reports its own peak.
pub fn reset_peak_rss() {
    // Refused in some containers; the peak is then that of the whole process, which is what its name says.
    let _ = std::fs::write("/proc/self/clear_refs", "5");
}

/// Memory that can still be used without swapping, in bytes, where the system tells.
pub fn available_memory_bytes() -> Option<u64> {
    kilobytes_in("/proc/meminfo", "MemAvailable:")
}

fn kilobytes_in(file: &str, field: &str) -> Option<u64> {
    let text = std::fs::read_to_string(file).ok()?;
    let value = text.lines().find_map(|line| line.strip_prefix(field))?;
    value
        .trim()
        .trim_end_matches("kB")
        .trim()
        .parse::<u64>()
        .ok()
        .map(|kb| kb * 1024)
}

/// What git says in the checkout this crate was built from; nothing outside one.
fn git(arguments: &[&str]) -> Option<String> {
    output_of(
        Command::new("git")
            .arg("-C")
            .arg(env!("CARGO_MANIFEST_DIR"))
            .args(arguments),
    )
}

/// What a command prints, if it is there and succeeds.
fn output_of(command: &mut Command) -> Option<String> {
    let output = command.output().ok()?;
    output
        .status
        .success()
        .then(|| String::from_utf8_lossy(&output.stdout).trim().to_owned())
}

fn cpu() -> String {
    let from_proc = std::fs::read_to_string("/proc/cpuinfo").ok().and_then(|text| {
        let line = text.lines().find(|line| line.starts_with("model name"))?;
        Some(line.split_once(':')?.1.trim().to_owned())
    });
    let from_sysctl = || output_of(Command::new("sysctl").args(["-n", "machdep.cpu.brand_string"]));
    from_proc
        .or_else(from_sysctl)
        .unwrap_or_else(|| std::env::consts::ARCH.into())
}

fn os() -> String {
    let release = std::fs::read_to_string("/etc/os-release").ok().and_then(|text| {
        let line = text.lines().find_map(|line| line.strip_prefix("PRETTY_NAME="))?;
        Some(line.trim_matches('"').to_owned())
    });
    match release {
        Some(release) => format!("{} ({release})", std::env::consts::OS),
        None => std::env::consts::OS.into(),
    }
}

/// `seconds` since 1970 as `2026-11-03T12:34:56Z`.
pub fn rfc3339(seconds: u64) -> String {
    let (year, month, day) = civil_date(seconds / 86_400);
    let second_of_day = seconds % 86_400;
    let (hour, minute, second) = (second_of_day / 3600, second_of_day / 60 % 60, second_of_day % 60);
    format!("{year:04}-{month:02}-{day:02}T{hour:02}:{minute:02}:{second:02}Z")
}

/// Days since 1970-01-01 as year, month, day; H. Hinnant's `civil_from_days` for days that are not negative.
fn civil_date(days: u64) -> (u64, u64, u64) {
    // Years start in March, so that the leap day comes last.
    let shifted = days + 719_468;
    let era = shifted / 146_097;
    let day_of_era = shifted % 146_097;
    let year_of_era = (day_of_era - day_of_era / 1460 + day_of_era / 36_524 - day_of_era / 146_096) / 365;
    let day_of_year = day_of_era - (365 * year_of_era + year_of_era / 4 - year_of_era / 100);
    let shifted_month = (5 * day_of_year + 2) / 153;
    let day = day_of_year - (153 * shifted_month + 2) / 5 + 1;
    let month = if shifted_month < 10 {
        shifted_month + 3
    } else {
        shifted_month - 9
    };
    (era * 400 + year_of_era + u64::from(month <= 2), month, day)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn dates_agree_with_the_calendar() {
        for (seconds, date) in [
            (0, "1970-01-01T00:00:00Z"),
            (951_782_399, "2000-02-28T23:59:59Z"),
            (951_782_400, "2000-02-29T00:00:00Z"),
            (1_709_251_199, "2024-02-29T23:59:59Z"),
            (1_709_251_200, "2024-03-01T00:00:00Z"),
            (4_102_444_799, "2099-12-31T23:59:59Z"),
        ] {
            assert_eq!(rfc3339(seconds), date);
        }
    }

    #[test]
    fn provenance_names_compiler_and_machine() {
        let provenance = provenance();
        assert!(provenance.rustc.starts_with("rustc "), "{}", provenance.rustc);
        assert!(!provenance.cpu.is_empty() && !provenance.os.is_empty() && provenance.cores > 0);
        assert!(same_machine(&provenance, &provenance.clone()));
    }

    #[test]
    #[cfg(target_os = "linux")]
    fn peak_memory_is_told() {
        assert!(peak_rss_bytes() > 100_000 && available_memory_bytes().is_some_and(|bytes| bytes > 0));
    }
}
