//! Figure 2: edge protection, with a progressive centre p₁ and a middle one q.

use super::drawing::{self, Drawing, Numbers, Picture};
use super::edge::{self, Middle, difference};
use super::run::{Run, short};
use crate::geometry::near::Disc;
use crate::suite::charts::scene::{Fill, Mark, Pen, Scene, Sheet};

/// A middle bite whose p₁ is progressive, and the run it is from.
pub(super) struct Figure2<'a> {
    pub run: &'a Run,
    pub found: Middle,
    /// The circle that p₁ was bitten on.
    pub p0: Disc,
    /// How many there were to choose from.
    pub seen: usize,
}

/// The clearest of all runs.
pub(super) fn find(runs: &[Run]) -> Result<Figure2<'_>, String> {
    let all = runs
        .iter()
        .flat_map(|run| edge::middle(run).into_iter().map(move |found| (run, found)));
    let all: Vec<Figure2> = all
        .filter_map(|(run, found)| {
            let p0 = found.p0?;
            Some(Figure2 {
                run,
                found,
                p0,
                seen: 0,
            })
        })
        .collect();
    let seen = all.len();
    let best = all.into_iter().max_by(|a, b| a.clarity().total_cmp(&b.clarity()));
    best.map(|best| Figure2 { seen, ..best })
        .ok_or_else(|| "no run has a middle bite next to a progressive one".to_owned())
}

impl Figure2<'_> {
    /// The gap between q₁ and q₂ beside the middle circle's radius, plus how much the circles of p₀ and p₂ differ: in a wide gap
    /// the three points are apart, and circles that differ show that f varies.
    fn clarity(&self) -> f64 {
        let Middle { q1, q2, q, p2, .. } = &self.found;
        (q1.centre.distance(q2.centre) / q.radius).min(1.0) + difference(&self.p0, p2).min(0.3)
    }

    fn scene(&self) -> Scene {
        let Middle { p1, p2, q1, q2, q, .. } = &self.found;
        let domain = &self.run.case.domain;
        let window = drawing::above(domain, &[self.p0, *p1, *p2, *q1, *q2, *q], q.centre.y);
        let mut scene = Scene::new("", window);
        drawing::ground(&mut scene, self.run, Fill::Domain);
        for (disc, pen) in [
            (q1, Pen::Tried),
            (q2, Pen::Tried),
            (&self.p0, Pen::Biting),
            (p1, Pen::Biting),
            (p2, Pen::Biting),
        ] {
            drawing::circle(&mut scene, domain, disc, pen);
        }
        drawing::circle(&mut scene, domain, q, Pen::Newest);
        let centres = [self.p0, *p1, *p2, *q].map(|disc| disc.centre);
        let on_segment = self.run.bites.iter().map(|bite| bite.centre);
        let level =
            on_segment.filter(|point| window.contains(*point) && point.y == q.centre.y && !centres.contains(point));
        level.for_each(|point| scene.point(point, Mark::Pale));
        for (disc, mark, words) in [
            (&self.p0, Mark::Centre, "p_0"),
            (p1, Mark::Centre, "p_1"),
            (p2, Mark::Centre, "p_2"),
            (q, Mark::Newest, "q"),
            (q1, Mark::Place, "q_1"),
            (q2, Mark::Place, "q_2"),
        ] {
            scene.named_point(disc.centre, mark, words);
        }
        let left = if p1.centre.x < p2.centre.x { 1.0 } else { -1.0 };
        for (disc, angle, words) in [
            (&self.p0, 90.0 + 25.0 * left, "c_b f(p_0)"),
            (p1, 90.0 + 45.0 * left, "c_b f(p_1)"),
            (p2, 90.0 - 25.0 * left, "c_b f(p_2)"),
            (q, 90.0, "c_b f(q)"),
        ] {
            drawing::radius(&mut scene, disc, angle, words);
        }
        scene
    }

    /// Picture, caption and numbers.
    pub fn drawing(&self) -> Drawing<'static> {
        let Middle { p1, p2, q1, q2, q, .. } = &self.found;
        let gap = q1.centre.distance(q2.centre);
        let caption = format!(
            "Edge protection: a centre on the boundary is where an earlier biting circle leaves it, as p₁, which lies on the circle \
             B(p₀, c_b f(p₀)); or the middle of the two points where earlier circles leave it, as q, the middle of q₁q₂: for the \
             progressive circle at q₁ (dashed) meets B(p₂, c_b f(p₂)), and the circle at q₂ (dashed) meets B(p₁, c_b f(p₁)), so \
             that neither is bitten.\n\n\
             c_b f is {} at p₀, {} at p₁, {} at q₁, {} at q, {} at q₂, {} at p₂; ‖q₁q₂‖ = {}, less than each of c_b f(q₁) and c_b \
             f(q₂). Thick: the boundary, with the domain above it; of circles, what is inside.\n\nDrawn from {}. Of {} such bites in all runs \
             searched, it is the one with the widest gap q₁q₂ for its circle and the most different circles.",
            short(self.p0.radius),
            short(p1.radius),
            short(q1.radius),
            short(q.radius),
            short(q2.radius),
            short(p2.radius),
            short(gap),
            self.run.told(),
            self.seen
        );
        let numbers = Numbers::default()
            .run(self.run)
            .disc("p0", &self.p0)
            .disc("p1", p1)
            .disc("q1", q1)
            .disc("q", q)
            .disc("q2", q2)
            .disc("p2", p2);
        Drawing {
            picture: Picture::Sheet(Sheet {
                columns: 1,
                scenes: vec![self.scene()],
            }),
            caption,
            numbers,
            commands: vec![self.run.asked.command()],
        }
    }
}
