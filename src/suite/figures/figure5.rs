//! Figure 5: biting circles on the boundary, labelled B(p₁) and M(p₁, p₂).

use super::drawing::{self, Drawing, Numbers, Picture};
use super::edge::{self, Middle, Progressive, difference};
use super::run::{Run, short};
use crate::geometry::DVec2;
use crate::geometry::near::Disc;
use crate::suite::charts::scene::{Fill, Mark, Pen, Scene, Sheet};
use crate::suite::lemmas::statements::least_progressive_height;
use crate::theory::least_meeting_height;

/// A bite of each label.
pub(super) struct Figure5<'a> {
    pub progressive: (&'a Run, Progressive),
    pub middle: (&'a Run, Middle),
    /// How many there were to choose from, of each.
    pub seen: [usize; 2],
}

/// The clearest of all runs.
pub(super) fn find(runs: &[Run]) -> Result<Figure5<'_>, String> {
    let (progressive, first) = best(runs, edge::progressive, |found| difference(&found.p1, &found.q));
    // The wider the gap, the lower is r.
    let (middle, second) = best(runs, edge::middle, |found| {
        found.q1.centre.distance(found.q2.centre) / found.q.radius + 0.5 * difference(&found.p1, &found.q)
    });
    Ok(Figure5 {
        progressive: progressive.ok_or("no run has a progressive bite on a level segment")?,
        middle: middle.ok_or("no run has a middle bite on a level segment")?,
        seen: [first, second],
    })
}

type Best<'a, T> = (Option<(&'a Run, T)>, usize);

fn best<T>(runs: &[Run], all: fn(&Run) -> Vec<T>, clarity: impl Fn(&T) -> f64) -> Best<'_, T> {
    let mut seen = 0;
    let found = runs
        .iter()
        .flat_map(|run| all(run).into_iter().map(move |found| (run, found)));
    let best = found
        .inspect(|_| seen += 1)
        .max_by(|a, b| clarity(&a.1).total_cmp(&clarity(&b.1)));
    (best, seen)
}

/// Circles, the triangle of their centres and r, and h_r.
fn scene(run: &Run, title: &str, circles: &[(&Disc, Pen)], [p1, q]: [&Disc; 2], r: DVec2) -> Scene {
    let discs: Vec<Disc> = circles.iter().map(|(disc, _)| **disc).collect();
    let mut scene = Scene::new(title, drawing::above(&run.case.domain, &discs, q.centre.y));
    drawing::ground(&mut scene, run, Fill::Domain);
    for (disc, pen) in circles {
        drawing::circle(&mut scene, &run.case.domain, disc, *pen);
    }
    let foot = DVec2::new(r.x, q.centre.y);
    scene.line([p1.centre, r, q.centre], Pen::Auxiliary);
    scene.length([foot, r], "h_r");
    scene
}

impl Figure5<'_> {
    fn scenes(&self) -> Vec<Scene> {
        let (run, Progressive { p1, q, r, .. }) = &self.progressive;
        let mut first = scene(
            run,
            "(a) q is labelled B(p₁)",
            &[(p1, Pen::Biting), (q, Pen::Newest)],
            [p1, q],
            *r,
        );
        first.named_point(p1.centre, Mark::Centre, "p_1");
        first.named_point(q.centre, Mark::Newest, "q");
        first.named_point(*r, Mark::Place, "r");
        let (
            run,
            Middle {
                p1, p2, q1, q2, q, r, ..
            },
        ) = &self.middle;
        let circles = [(p1, Pen::Biting), (p2, Pen::Biting), (q, Pen::Newest)];
        let mut second = scene(run, "(b) q is labelled M(p₁, p₂)", &circles, [p1, q], *r);
        for (disc, mark, words) in [
            (p1, Mark::Centre, "p_1"),
            (p2, Mark::Centre, "p_2"),
            (q1, Mark::Place, "q_1"),
            (q2, Mark::Place, "q_2"),
            (q, Mark::Newest, "q"),
        ] {
            second.named_point(disc.centre, mark, words);
        }
        second.named_point(*r, Mark::Place, "r");
        vec![first, second]
    }

    fn caption(&self) -> String {
        let ((first, a), (second, b)) = (&self.progressive, &self.middle);
        let is_attained = a.h_r / a.p1.radius < least_progressive_height(first.case.t()) * (1.0 + 1e-6);
        let attained = match is_attained {
            true => ", which is attained: f falls from p₁ to q as steeply as it may",
            false => "",
        };
        format!(
            "Biting circles on the boundary. (a) The centre q of the new circle is labelled B(p₁): it lies on the circle of p₁, which \
             was chosen before it. (b) The centre q is labelled M(p₁, p₂): it is the middle of q₁q₂, where the circles of p₁ and p₂ \
             leave the boundary. In both, r is where the circles of p₁ and q meet inside the domain, and h_r is its distance to the \
             boundary.\n\n\
             (a) h_r / (c_b f(p₁)) = {}, and Lemma 6.3 promises at least {} for t = {}{attained}. (b) h_r / (c_b f(p₁)) = {}, and Lemma 6.4 \
             promises at least {} for t = {}.\n\nDrawn (a) from {}, of {} such bites the one whose circles differ most; (b) from {}, of \
             {} such bites the one with the widest gap q₁q₂ for its circle, circles that differ preferred.",
            short(a.h_r / a.p1.radius),
            short(least_progressive_height(first.case.t())),
            short(first.case.t()),
            short(b.h_r / b.p1.radius),
            short(least_meeting_height(second.case.t())),
            short(second.case.t()),
            first.told(),
            self.seen[0],
            second.told(),
            self.seen[1]
        )
    }

    /// Picture, caption and numbers.
    pub fn drawing(&self) -> Drawing<'static> {
        let ((first, a), (second, b)) = (&self.progressive, &self.middle);
        let numbers_a = Numbers::default()
            .run(first)
            .disc("p1", &a.p1)
            .disc("q", &a.q)
            .point("r", a.r)
            .number("h_r", a.h_r);
        let numbers_b = Numbers::default()
            .run(second)
            .disc("p1", &b.p1)
            .point("q1", b.q1.centre)
            .disc("q", &b.q)
            .point("q2", b.q2.centre)
            .disc("p2", &b.p2)
            .point("r", b.r)
            .number("h_r", b.h_r);
        Drawing {
            picture: Picture::Sheet(Sheet {
                columns: 2,
                scenes: self.scenes(),
            }),
            caption: self.caption(),
            numbers: Numbers::default().with("a", numbers_a).with("b", numbers_b),
            commands: vec![first.asked.command(), second.asked.command()],
        }
    }
}
