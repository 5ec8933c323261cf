//! The sections of a page: one list of all there are.

use super::drawer::Drawer;
use super::{
    adaptation, angle, certificate, corners, duels, fewest, frontier, meshes, methods, orders, oversampling, peers,
    poisson, rules, seams, size, tally, tasks, threads, time,
};
use crate::suite::analysis::results::Results;
use crate::suite::charts::ChartError;
use crate::suite::run::plan::Section;

/// What a page has of one section.
pub(super) struct Entry {
    /// Its heading.
    pub(super) title: &'static str,
    /// What it adds to the main findings, a sentence each.
    pub(super) findings: fn(&Results) -> Vec<String>,
    /// Its text and tables.
    pub(super) text: fn(&Results) -> String,
    /// Draws its charts.
    pub(super) charts: fn(&Results, &mut Drawer) -> Result<(), ChartError>,
}

impl Entry {
    fn new(
        title: &'static str,
        findings: fn(&Results) -> Vec<String>,
        text: fn(&Results) -> String,
        charts: fn(&Results, &mut Drawer) -> Result<(), ChartError>,
    ) -> Self {
        Self {
            title,
            findings,
            text,
            charts,
        }
    }

    /// The entry of a section.
    pub(super) fn of(section: Section) -> Self {
        match section {
            Section::Angle => Self::new(
                "Smallest angle against its bound",
                angle::findings,
                angle::text,
                angle::charts,
            ),
            Section::Size => Self::new("Size", size::findings, size::text, size::charts),
            Section::Fewest => Self::new(
                "Fewest triangles for a smallest angle",
                fewest::findings,
                fewest::text,
                fewest::charts,
            ),
            Section::Frontier => Self::new(
                "What a smallest angle costs",
                frontier::findings,
                frontier::text,
                frontier::charts,
            ),
            Section::Corners => Self::new("Corners", corners::findings, corners::text, corners::charts),
            Section::Rules => Self::new("Who bites whom", rules::findings, rules::text, rules::charts),
            Section::Orders => Self::new("Orders of bites", orders::findings, orders::text, orders::charts),
            Section::Time => Self::new("Time, step by step", time::findings, time::text, time::charts),
            Section::Methods => Self::new("Meshers side by side", no_findings, methods::text, methods::charts),
            Section::Poisson => Self::new("What quality is for", poisson::findings, poisson::text, poisson::charts),
            Section::Adaptation => Self::new("Adaptation", adaptation::findings, adaptation::text, adaptation::charts),
            Section::Peers => Self::new("Beside the meshers people use", no_findings, peers::text, no_charts),
            Section::Tasks => Self::new("Task by task", no_findings, tasks::text, no_charts),
            Section::Threads => Self::new("Threads", no_findings, threads::text, no_charts),
            Section::Duels => Self::new(
                "Who wins, who loses, and why",
                duels::findings,
                duels::text,
                duels::charts,
            ),
            Section::Seams => Self::new("Where fronts meet", seams::findings, seams::text, seams::charts),
            Section::Oversampling => Self::new(
                "What oversampling costs",
                oversampling::findings,
                oversampling::text,
                oversampling::charts,
            ),
            Section::Certificate => Self::new("Certificate", certificate::findings, certificate::text, no_charts),
            Section::Tally => Self::new("Cases", tally::findings, tally::text, no_charts),
            Section::Meshes => Self::new("Meshes", no_findings, meshes::text, meshes::charts),
        }
    }
}

/// The charts of a section that has none.
fn no_charts(_: &Results, _: &mut Drawer) -> Result<(), ChartError> {
    Ok(())
}

/// The findings of a section that has none.
fn no_findings(_: &Results) -> Vec<String> {
    Vec::new()
}
