//! Figure 3: biting, packing and extended circles.

use super::drawing::{self, Drawing, Numbers, Picture};
use super::front::covers;
use super::run::{Run, short};
use crate::geometry::DVec2;
use crate::geometry::near::Disc;
use crate::meshers::Reason;
use crate::suite::charts::scene::{Fill, Mark, Pen, Scene, Sheet};
use crate::theory::{Promises, Rule, packing_constant};

/// A biting circle in the interior, and what the panels show of it.
pub(super) struct Figure3<'a> {
    pub run: &'a Run,
    /// B(x, c_b f(x)).
    pub x: Disc,
    /// Its packing circle, c_p f(x) with c_p = c_b / (2 + t).
    pub packing: Disc,
    /// A point that two biting circles cover, x's and `other`; and how many do.
    pub y: DVec2,
    pub other: Disc,
    pub covering: usize,
    /// The extended circle, c_e f(x) with c_e = 2 c_b / (1 − t).
    pub extended: Disc,
    /// The centre nearest to x.
    pub nearest: Disc,
    /// All other centres in the extended circle.
    pub within: usize,
    /// How many circles there were to choose from.
    pub seen: usize,
}

/// The clearest of all runs: the circle whose neighbours differ most from it, so that f is seen to vary.
pub(super) fn find(runs: &[Run]) -> Result<Figure3<'_>, String> {
    let mut seen = 0;
    let all = runs
        .iter()
        .flat_map(|run| (0..run.bites.len()).filter_map(move |k| of_bite(run, k)));
    let best = all
        .inspect(|_| seen += 1)
        .max_by(|a, b| a.clarity().total_cmp(&b.clarity()));
    best.map(|best| Figure3 { seen, ..best })
        .ok_or_else(|| "no run has a bite so deep in the interior that its extended circle is, too".to_owned())
}

/// nn of a mesh vertex over its biting radius is at most this (Lemma 5.7).
fn largest_nn(t: f64) -> f64 {
    let rule = Rule::Earlier;
    Promises { rule, t }.nn_at_vertices()[1]
}

/// What there is to show of a bite, where its extended circle lies in the domain and it shares a point with one other alone.
fn of_bite(run: &Run, k: usize) -> Option<Figure3<'_>> {
    if run.bites[k].reason != Reason::FrontVertex {
        return None;
    }
    let (x, t) = (run.disc(k), run.case.t());
    let scaled = |factor: f64| Disc {
        radius: factor * x.radius,
        ..x
    };
    let (packing, extended) = (scaled(packing_constant(1.0, t)), scaled(largest_nn(t)));
    let (_, to_boundary) = run.case.domain.index().nearest(x.centre)?;
    if to_boundary < extended.radius {
        return None;
    }
    let others: Vec<Disc> = (0..run.bites.len())
        .filter(|other| *other != k)
        .map(|other| run.disc(other))
        .collect();
    let distance = |other: &Disc| other.centre.distance(x.centre);
    let shared = others
        .iter()
        .filter(|other| distance(other) < x.radius + other.radius)
        .map(|other| {
            let deep = 0.5 * (distance(other) - other.radius + x.radius);
            let y = x.centre + deep * (other.centre - x.centre) / distance(other);
            (y, *other, 1 + others.iter().filter(|disc| covers(disc, y)).count())
        });
    // The widest lens in which a point is covered twice and not thrice.
    let twice = shared.filter(|(_, _, count)| *count == 2);
    let width = |other: &Disc| (x.radius + other.radius - distance(other)) / x.radius;
    let (y, other, covering) = twice.max_by(|a, b| width(&a.1).total_cmp(&width(&b.1)))?;
    let nearest = *others.iter().min_by(|a, b| distance(a).total_cmp(&distance(b)))?;
    Some(Figure3 {
        run,
        packing,
        y,
        other,
        covering,
        extended,
        nearest,
        within: others.iter().filter(|other| distance(other) < extended.radius).count(),
        x,
        seen: 0,
    })
}

impl Figure3<'_> {
    fn clarity(&self) -> f64 {
        let lens = self.x.radius + self.other.radius - self.x.centre.distance(self.other.centre);
        (self.other.radius / self.x.radius - 1.0).abs() + 0.3 * lens / self.x.radius
    }

    /// A square window around a circle.
    fn scene(&self, title: &str, around: Disc, margin: f64) -> Scene {
        let mut scene = Scene::new(title, drawing::around(&[around], margin));
        for corners in &self.run.ground {
            scene.area(*corners, Fill::Domain);
        }
        scene
    }

    fn packing_and_biting(&self) -> Scene {
        let mut scene = self.scene("(a) the biting and the packing circle", self.x, 0.35);
        let share = self.packing.radius / self.x.radius;
        let others = self.run.bites.iter().filter(|bite| bite.centre != self.x.centre);
        for bite in others {
            let disc = Disc {
                centre: bite.centre,
                radius: share * bite.radius,
            };
            scene.circle(disc, Pen::Pale);
        }
        scene.circle(self.x, Pen::Biting);
        scene.circle(self.packing, Pen::Packing);
        drawing::other_centres(&mut scene, self.run, &[self.x.centre]);
        scene.named_point(self.x.centre, Mark::Centre, "x");
        drawing::radius(&mut scene, &self.x, 35.0, "c_b f(x)");
        drawing::radius(&mut scene, &self.packing, 145.0, "c_p f(x)");
        scene
    }

    fn covered_twice(&self) -> Scene {
        let both = drawing::around(&[self.x, self.other], 0.0);
        let both = Disc {
            centre: both.centre(),
            radius: 0.5 * both.size().max_element(),
        };
        let mut scene = self.scene("(b) a point in two biting circles", both, 0.12);
        let named = [self.x.centre, self.other.centre];
        let others = self.run.bites.iter().filter(|bite| !named.contains(&bite.centre));
        for bite in others {
            let disc = Disc {
                centre: bite.centre,
                radius: bite.radius,
            };
            scene.circle(disc, Pen::Pale);
        }
        scene.circle(self.x, Pen::Biting);
        scene.circle(self.other, Pen::Newest);
        drawing::other_centres(&mut scene, self.run, &named);
        scene.named_point(self.x.centre, Mark::Centre, "x");
        scene.named_point(self.other.centre, Mark::Newest, "z");
        scene.named_point(self.y, Mark::Place, "y");
        scene
    }

    fn extended(&self) -> Scene {
        let mut scene = self.scene("(c) the extended circle", self.extended, 0.03);
        scene.circle(self.x, Pen::Biting);
        scene.circle(self.extended, Pen::Extended);
        scene.circle(self.nearest, Pen::Newest);
        drawing::other_centres(&mut scene, self.run, &[self.x.centre, self.nearest.centre]);
        scene.named_point(self.x.centre, Mark::Centre, "x");
        scene.named_point(self.nearest.centre, Mark::Newest, "z");
        let away = (self.x.centre - self.nearest.centre).to_angle().to_degrees();
        drawing::radius(&mut scene, &self.extended, away + 20.0, "c_e f(x)");
        scene
    }

    /// Picture, caption and numbers.
    pub fn drawing(&self) -> Drawing<'static> {
        let (c_b, t) = (self.run.asked.c_b, self.run.case.t());
        let nn = self.nearest.centre.distance(self.x.centre);
        let caption = format!(
            "Biting and packing circles. (a) The biting circle B(x, c_b f(x)) and the packing circle B(x, c_p f(x)) of a point x, with \
             c_p = c_b / (2 + t); pale: the packing circles of the other points, none of which overlap (Lemma 5.4). (b) A point y \
             that two biting circles cover, B(x, c_b f(x)) and B(z, c_b f(z)). (c) For every biting circle B(x, c_b f(x)) there is \
             a biting circle whose centre z lies in the extended circle B(x, c_e f(x)), c_e = 2 c_b / (1 − t).\n\n\
             c_b = {}, t = {}, c_p = {}, c_e = {}; c_b f is {} at x and {} at z of (b). y, in the middle of what the two circles share \
             on xz, is in {} biting circles. In (c) z is the nearest centre, at {} of c_b f(x) where Lemma 5.7 has it between {} \
             and {}; {} centres other than x lie in the extended circle.\n\nDrawn from {}. Of {} circles in all runs searched whose \
             extended circle lies in the domain and that share a point with one other alone, it is the one with the most unequal \
             neighbour, a wide lens preferred.",
            short(c_b),
            short(t),
            short(packing_constant(c_b, t)),
            short(c_b * largest_nn(t)),
            short(self.x.radius),
            short(self.other.radius),
            self.covering,
            short(nn / self.x.radius),
            short(1.0 - t),
            short(largest_nn(t)),
            self.within,
            self.run.told(),
            self.seen
        );
        let numbers = Numbers::default()
            .run(self.run)
            .disc("x", &self.x)
            .disc("packing", &self.packing)
            .point("y", self.y)
            .disc("z_of_b", &self.other)
            .disc("extended", &self.extended)
            .disc("z_of_c", &self.nearest)
            .with("centres_in_extended", self.within);
        Drawing {
            picture: Picture::Sheet(Sheet {
                columns: 3,
                scenes: vec![self.packing_and_biting(), self.covered_twice(), self.extended()],
            }),
            caption,
            numbers,
            commands: vec![self.run.asked.command()],
        }
    }
}
