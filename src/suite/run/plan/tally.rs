//! Groups whose cases are tallied: 10⁵ small cases would be 10⁵ rows that say the same.

use serde::Deserialize;

/// What a group says that is tallied. Each of its domains is meshed by every method, with a spacing, a t and a c_b drawn from the
/// group's lists for each mesh.
#[derive(Clone, Debug, PartialEq, Eq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Tallied {
    /// Names of the families, in the order of the table. In the group's `domains` `{family}` stands for one of them: a domain there is a
    /// gallery name with `{seed}` in it, drawn many times, or else a folder, of which every file is a domain.
    pub families: Vec<String>,
    /// How many domains of each family are drawn: seeds 0, 1, ….
    #[serde(default)]
    pub draws: usize,
    /// The command that makes the folders, named where one is missing.
    #[serde(default)]
    pub fetch: Option<String>,
}

impl Tallied {
    /// What is wrong with it beside these domains, if something is.
    pub(super) fn check(&self, domains: &[String]) -> Result<(), String> {
        if self.families.is_empty() {
            return Err("`families` is empty; fill it".into());
        }
        if self.draws == 0 && domains.iter().any(|domain| domain.contains("{seed}")) {
            return Err("say how many `draws` of a domain with `{seed}`".into());
        }
        Ok(())
    }
}
