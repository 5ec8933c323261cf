//! What cells share: domain, spacing, limited spacing, and their integrals, each made once.

use crate::Case;
use crate::domain::{self, Domain, DomainError, RepairReport};
use crate::spacing::{self, ControlSpacing, Integral, Lfs, Options, SpacingError};
use crate::suite::peers::size_field::SizeField;
use crate::suite::rows::adapted::Round;
use crate::suite::rows::record::Cell;
use crate::suite::run::adapt::{self, Ended};
use crate::suite::run::work::Outlook;
use std::collections::BTreeMap;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Arc, Mutex, OnceLock, PoisonError};

/// Relative error asked of the integrals in rows.
pub const INTEGRAL_ERROR: f64 = 1e-3;

/// Why there is nothing to mesh.
#[derive(Clone, Debug, thiserror::Error)]
pub enum PrepareError {
    /// The domain cannot be read or is not valid.
    #[error(transparent)]
    Domain(#[from] DomainError),
    /// The spacing cannot be read or is not positive.
    #[error("on {domain}: {cause}")]
    Spacing {
        /// Where.
        domain: String,
        /// What is wrong with it.
        cause: SpacingError,
    },
    /// A round of adaptation ended without a spacing.
    #[error("on {domain}: {}", ended.reason)]
    Adaptation {
        /// Where.
        domain: String,
        /// What ended it.
        ended: Ended,
    },
}

/// A domain with the integral of its local feature size.
pub struct Site {
    /// The domain.
    pub domain: Arc<Domain>,
    /// Its local feature size.
    pub lfs: Arc<Lfs>,
    /// ∫ dA / lfs².
    pub integral_lfs: Integral,
}

/// A spacing on a domain, capped by lfs if asked for, not limited.
#[derive(Clone)]
struct Base {
    site: Arc<Site>,
    spacing: ControlSpacing,
    integral: Integral,
    rounds: Arc<[Round]>,
}

/// All a mesher and its judge need: domain, limited spacing, integral.
#[derive(Clone)]
pub struct Prepared {
    /// Where.
    pub site: Arc<Site>,
    /// The spacing, limited; its SPEC has the numbers of this domain in it.
    pub spacing: ControlSpacing,
    /// ∫ dA / f² of that.
    pub integral: Integral,
    /// The rounds of adaptation by which the spacing came about.
    pub rounds: Arc<[Round]>,
    /// The spacing as peers get it, once one has asked for it.
    pub size_field: Arc<OnceLock<SizeField>>,
}

impl Prepared {
    /// The case of that c_b.
    pub fn case(&self, c_b: f64) -> Case {
        Case {
            integral: Some(self.integral),
            ..Case::of(self.site.domain.clone(), self.spacing.clone(), c_b)
        }
    }
}

/// A value that several threads may ask for at once, made by the first.
type Slot<T> = Arc<OnceLock<Result<T, PrepareError>>>;

/// Values by name, each made once.
struct Shelf<K, T> {
    slots: Mutex<BTreeMap<K, Slot<T>>>,
}

impl<K: Ord, T: Clone> Shelf<K, T> {
    fn new() -> Self {
        Self {
            slots: Mutex::new(BTreeMap::new()),
        }
    }

    fn get(&self, key: K, make: impl FnOnce() -> Result<T, PrepareError>) -> Result<T, PrepareError> {
        // The shelf is free again before the value is made: others can be made meanwhile.
        let slot = self
            .slots
            .lock()
            .unwrap_or_else(PoisonError::into_inner)
            .entry(key)
            .or_default()
            .clone();
        slot.get_or_init(make).clone()
    }
}

/// Domains and spacings, kept for all cells of a sweep. Limited spacings are not kept: there are as many as values of α.
pub struct Store {
    limit_factor: Option<f64>,
    most_vertices: Option<usize>,
    repair: bool,
    repairs: Mutex<Vec<RepairReport>>,
    domains: Shelf<String, Arc<Domain>>,
    sites: Shelf<String, Arc<Site>>,
    bases: Shelf<(String, String, bool, Option<String>), Arc<Base>>,
}

impl Store {
    /// An empty store. `limit_factor` is [`Options::limit_factor`], its default if absent; `repair` mends domain files.
    pub fn new(limit_factor: Option<f64>, repair: bool) -> Self {
        Self {
            limit_factor,
            most_vertices: None,
            repair,
            repairs: Mutex::new(Vec::new()),
            domains: Shelf::new(),
            sites: Shelf::new(),
            bases: Shelf::new(),
        }
    }

    /// The same, whose adaptations make no mesh of more vertices.
    pub fn up_to(mut self, most_vertices: Option<usize>) -> Self {
        self.most_vertices = most_vertices;
        self
    }

    /// The domain of that gallery name or file.
    ///
    /// # Errors
    /// [`PrepareError::Domain`].
    pub fn domain(&self, name: &str) -> Result<Arc<Domain>, PrepareError> {
        self.domains.get(name.to_owned(), || {
            if !self.repair {
                return Ok(Arc::new(domain::load(name)?));
            }
            let (mended, changes) = domain::repair(domain::read(name)?);
            let domain = Domain::new(mended)?;
            self.repairs
                .lock()
                .unwrap_or_else(PoisonError::into_inner)
                .push(changes);
            Ok(Arc::new(domain))
        })
    }

    /// What was mended so far, by domain in the order in which they were read.
    pub fn repairs(&self) -> Vec<RepairReport> {
        self.repairs.lock().unwrap_or_else(PoisonError::into_inner).clone()
    }

    /// Makes the domains and spacings of all cells, side by side. What is wrong with one is told when it is asked for.
    pub fn survey<'a>(&self, cells: impl IntoIterator<Item = &'a Cell>, threads: usize) {
        // Adapting is work, and no survey.
        let distinct: BTreeMap<_, &Cell> = cells
            .into_iter()
            .filter(|cell| cell.adapt.is_none())
            .map(|cell| ((&cell.domain, &cell.spacing, cell.lfs_cap), cell))
            .collect();
        let distinct: Vec<&Cell> = distinct.into_values().collect();
        let next = AtomicUsize::new(0);
        // Threads of our own: one of rayon's, waiting here, could be handed the very value it waits for.
        std::thread::scope(|scope| {
            for _ in 0..threads {
                scope.spawn(|| {
                    while let Some(cell) = distinct.get(next.fetch_add(1, Ordering::Relaxed)) {
                        // The error stays on the shelf.
                        let _ = self.base(cell);
                    }
                });
            }
        });
    }

    /// What is known of a cell's spacing before limiting.
    ///
    /// # Errors
    /// [`PrepareError`].
    pub fn outlook(&self, cell: &Cell) -> Result<Outlook, PrepareError> {
        if cell.adapt.is_some() {
            // Nothing, until it has been adapted.
            return Ok(Outlook {
                lipschitz: f64::INFINITY,
                integral: 0.0,
            });
        }
        let base = self.base(cell)?;
        Ok(Outlook {
            lipschitz: base.spacing.function.lipschitz(),
            integral: base.integral.value,
        })
    }

    /// The cell's domain and spacing, limited to `alpha` if that is given.
    ///
    /// # Errors
    /// [`PrepareError`].
    pub fn prepare(&self, cell: &Cell, alpha: Option<f64>) -> Result<Prepared, PrepareError> {
        let base = self.base(cell)?;
        let mut prepared = Prepared {
            site: base.site.clone(),
            spacing: base.spacing.clone(),
            integral: base.integral,
            rounds: base.rounds.clone(),
            size_field: Arc::default(),
        };
        let Some(alpha) = alpha else {
            return Ok(prepared);
        };
        let domain = &*prepared.site.domain;
        let (function, factor) = (base.spacing.function.clone(), self.options(cell, alpha).limit_factor);
        prepared.spacing.function = spacing::limit(function, domain, alpha, factor).map_err(told(domain))?;
        prepared.integral =
            spacing::integrate(&*prepared.spacing.function, domain, INTEGRAL_ERROR).map_err(told(domain))?;
        Ok(prepared)
    }

    /// The cell's domain and spacing, limited as its t and c_b ask.
    ///
    /// # Errors
    /// [`PrepareError`].
    pub fn prepare_for_t(&self, cell: &Cell) -> Result<Prepared, PrepareError> {
        let alpha = cell.t / cell.c_b;
        self.prepare(cell, (alpha < self.outlook(cell)?.lipschitz).then_some(alpha))
    }

    fn options(&self, cell: &Cell, alpha: f64) -> Options {
        let defaults = Options::with_alpha(alpha);
        Options {
            lfs_cap: cell.lfs_cap,
            limit_factor: self.limit_factor.unwrap_or(defaults.limit_factor),
            ..defaults
        }
    }

    /// The domain of that gallery name or file, with what lfs says of it.
    ///
    /// # Errors
    /// [`PrepareError`].
    pub fn site(&self, name: &str) -> Result<Arc<Site>, PrepareError> {
        self.sites.get(name.to_owned(), || {
            let domain = self.domain(name)?;
            let lfs = Arc::new(spacing::lfs_of(&domain).map_err(told(&domain))?);
            let integral_lfs = spacing::integrate(&*lfs, &domain, INTEGRAL_ERROR).map_err(told(&domain))?;
            Ok(Arc::new(Site {
                domain,
                lfs,
                integral_lfs,
            }))
        })
    }

    fn base(&self, cell: &Cell) -> Result<Arc<Base>, PrepareError> {
        let key = (
            cell.domain.clone(),
            cell.spacing.clone(),
            cell.lfs_cap,
            cell.adapted_by(),
        );
        self.bases.get(key, || {
            let site = self.site(&cell.domain)?;
            let spec = fill_in(&cell.spacing, &site.domain);
            let options = self.options(cell, f64::INFINITY);
            let mut built = spacing::build_with(&spec, &site.domain, &options, || Ok(site.lfs.clone()))
                .map_err(told(&site.domain))?;
            let mut rounds = Vec::new();
            if cell.adapt.is_some() && built.function.is_geodesic() {
                let message = "does not go with adaptation, which caps each round by lfs; use lfs as spacing";
                return Err(told(&site.domain)(SpacingError::Geodesic { message }));
            }
            if cell.adapt.is_some() {
                let limits = adapt::Limits {
                    factor: options.limit_factor,
                    vertices: self.most_vertices,
                };
                let lfs = built.lfs_cap.then(|| site.lfs.clone());
                let adapted = adapt::run(&site.domain, lfs, built.function, cell, limits);
                (built.function, rounds) = adapted.map_err(|ended| PrepareError::Adaptation {
                    domain: site.domain.name().to_owned(),
                    ended,
                })?;
            }
            let integral = if built.spec == "lfs" && rounds.is_empty() {
                site.integral_lfs
            } else {
                spacing::integrate(&*built.function, &site.domain, INTEGRAL_ERROR).map_err(told(&site.domain))?
            };
            Ok(Arc::new(Base {
                site,
                spacing: built,
                integral,
                rounds: rounds.into(),
            }))
        })
    }
}

fn told(domain: &Domain) -> impl Fn(SpacingError) -> PrepareError + use<> {
    let domain = domain.name().to_owned();
    move |cause| PrepareError::Spacing {
        domain: domain.clone(),
        cause,
    }
}

/// Puts the domain's box into a spacing: `{x0}`, `{y0}` its lower left corner, `{w}`, `{h}` its width and height. One
/// text can then stand for domains of any size.
pub(super) fn fill_in(spacing: &str, domain: &Domain) -> String {
    let (corner, size) = (domain.bounds().min, domain.bounds().size());
    [("{x0}", corner.x), ("{y0}", corner.y), ("{w}", size.x), ("{h}", size.y)]
        .iter()
        .fold(spacing.to_owned(), |text, (name, value)| {
            text.replace(name, &format!("({value})"))
        })
}
