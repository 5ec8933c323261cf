//! Who bites whom: which of two points sets the distance that they must keep.

use serde::{Deserialize, Serialize};

/// Whose spacing sets the distance of two points x and y, x bitten before y. With g = c_b f and t its Lipschitz constant:
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Rule {
    /// That of the earlier point, ‖x − y‖ ≥ g(x), as in the paper: y lies in no circle of those before it. Biting ends when
    /// every point z of the domain has ‖x − z‖ ≤ g(x) for some x.
    #[default]
    Earlier,
    /// That of the later point, ‖x − y‖ ≥ g(y): no point before lies in the circle of y. Biting ends when every point z of
    /// the domain has ‖x − z‖ ≤ g(z) for some x.
    Later,
}

impl Rule {
    /// What of two things, that of the point bitten first and that of the other, the distance of the two is held against.
    pub fn of<T>(self, earlier: T, later: T) -> T {
        match self {
            Self::Earlier => earlier,
            Self::Later => later,
        }
    }
}
