//! Figure 4: triangles that see their circumcentre, and triangles that do not.

use super::drawing::{self, Drawing, Numbers, Picture};
use super::run::{Run, short};
use super::tolerance::PULLED_IN;
use crate::geometry::DVec2;
use crate::geometry::near::Disc;
use crate::geometry::predicates::{Meeting, in_circle, orient2d, segments_meet};
use crate::quality::shape::{angles_deg, circumcentre};
use crate::suite::charts::scene::{Fill, Mark, Pen, Scene, Sheet};

/// A triangle whose circumcentre lies outside it.
#[derive(Clone, Copy, Debug)]
pub(super) struct Obtuse {
    /// The corners, the one with the obtuse angle last: the circumcentre is beyond the side of the first two.
    pub corners: [DVec2; 3],
    /// The circumcircle.
    pub circle: Disc,
    /// The segment between the triangle and its circumcentre, if there is one.
    pub cut_by: Option<usize>,
    /// Whether the circumcentre is in the domain.
    pub is_inside: bool,
    /// Whether no mesh vertex is in the circumcircle. If the mesh is a Delaunay triangulation only because pieces were forced,
    /// there may be some, across a segment.
    pub is_delaunay: bool,
}

impl Obtuse {
    /// How far beyond its longest side the circumcentre lies, as a share of the circumradius: what makes the figure clear.
    fn depth(&self) -> f64 {
        let [a, b, _] = self.corners;
        (b - a).perp_dot(self.circle.centre - a).abs() / a.distance(b) / self.circle.radius
    }
}

/// One triangle of each sort.
pub(super) struct Figure4<'a> {
    /// Of the first subset, and a biting circle that covers its circumcentre.
    pub seen: (&'a Run, Obtuse),
    pub covering: Disc,
    /// Of the second subset, the circumcentre outside the domain.
    pub cut_off: (&'a Run, Obtuse),
    /// Of the second subset, the circumcentre in the domain; and the segment between them.
    pub cut_off_inside: (&'a Run, Obtuse),
    /// How many triangles there are of each sort among all runs, and how many of the last are cut off by a segment that has
    /// the domain on one side only.
    pub counts: [usize; 3],
    pub one_sided: usize,
    /// How many would be of the last sort, had they no vertices in their circumcircles.
    pub forced: usize,
    pub triangles: usize,
}

/// The clearest of all runs.
pub(super) fn find(runs: &[Run]) -> Result<Figure4<'_>, String> {
    let all: Vec<(&Run, Obtuse)> = runs
        .iter()
        .flat_map(|run| obtuse(run).map(move |found| (run, found)))
        .collect();
    let sort = |wanted: fn(&Obtuse) -> bool| {
        let own = all.iter().filter(move |(_, found)| found.is_delaunay && wanted(found));
        let best = own.clone().max_by(|a, b| a.1.depth().total_cmp(&b.1.depth()));
        (best.copied(), own.count())
    };
    let (seen, first) = sort(|found| found.cut_by.is_none() && found.is_inside);
    let (cut_off, second) = sort(|found| found.cut_by.is_some() && !found.is_inside);
    let (cut_off_inside, third) = sort(|found| found.cut_by.is_some() && found.is_inside);
    let one_sided = |(run, found): &&(&Run, Obtuse)| {
        found.is_inside && found.cut_by.is_some_and(|segment| run.case.domain.is_boundary(segment))
    };
    let seen = seen.ok_or("no run has an obtuse triangle that sees its circumcentre")?;
    Ok(Figure4 {
        covering: covering(seen.0, &seen.1).ok_or("a circumcentre in the domain is in no biting circle")?,
        seen,
        cut_off: cut_off.ok_or("no run has a triangle that the boundary cuts off from its circumcentre")?,
        cut_off_inside: cut_off_inside.ok_or("no run has such a triangle with its circumcentre in the domain")?,
        counts: [first, second, third],
        one_sided: all.iter().filter(one_sided).count(),
        forced: all
            .iter()
            .filter(|(_, found)| found.is_inside && found.cut_by.is_some() && !found.is_delaunay)
            .count(),
        triangles: runs.iter().map(|run| run.mesh.triangles.len()).sum(),
    })
}

/// The triangles of a mesh with an angle over 90° by this much: others have their circumcentre inside, or hardly outside.
const OBTUSE_DEG: f64 = 91.0;

fn obtuse(run: &Run) -> impl Iterator<Item = Obtuse> + '_ {
    (0..run.mesh.triangles.len()).filter_map(|t| {
        let corners = run.mesh.corners(t);
        let k = (0..3).find(|k| angles_deg(corners)[*k] > OBTUSE_DEG)?;
        let corners = [corners[(k + 1) % 3], corners[(k + 2) % 3], corners[k]];
        let centre = circumcentre(corners);
        let circle = Disc {
            centre,
            radius: centre.distance(corners[0]),
        };
        Some(Obtuse {
            corners,
            circle,
            cut_by: cut_by(run, corners, centre),
            is_inside: run.case.domain.contains(centre),
            is_delaunay: is_delaunay(run, corners),
        })
    })
}

/// Whether no mesh vertex is within the circle through three counter-clockwise corners, decided exactly.
fn is_delaunay(run: &Run, [a, b, c]: [DVec2; 3]) -> bool {
    run.mesh.points.iter().all(|&point| in_circle(a, b, c, point) <= 0.0)
}

/// The segment that hides some of a triangle from its circumcentre, if there is one. What hides it has a part within the triangle
/// and the circumcentre's hull, outside the triangle: so it crosses a line of sight to a corner, or has an end in there.
fn cut_by(run: &Run, corners: [DVec2; 3], centre: DVec2) -> Option<usize> {
    let [a, b, _] = corners;
    let inner = corners.iter().sum::<DVec2>() / 3.0;
    // Rounding puts corners on a segment beside it: take points a little further in.
    let seen = corners.map(|corner| corner.lerp(inner, PULLED_IN));
    let holds = |p: DVec2| orient2d(a, b, p) < 0.0 && orient2d(b, centre, p) < 0.0 && orient2d(centre, a, p) < 0.0;
    let hides = |segment: &usize| {
        let [p, q] = run.case.domain.ends(*segment);
        let crosses = |corner: DVec2| segments_meet(centre, corner, p, q) == Meeting::Cross;
        seen.into_iter().any(crosses) || holds(p) || holds(q)
    };
    (0..run.case.domain.segments().len()).find(hides)
}

/// The biting circle that covers the circumcentre deepest.
fn covering(run: &Run, found: &Obtuse) -> Option<Disc> {
    let depth = |disc: &Disc| disc.radius - disc.centre.distance(found.circle.centre);
    let best = run
        .discs(run.bites.len())
        .into_iter()
        .max_by(|u, v| depth(u).total_cmp(&depth(v)));
    best.filter(|disc| depth(disc) >= 0.0)
}

/// A triangle with its circumcircle in the mesh.
fn scene(run: &Run, title: &str, found: &Obtuse, names: [&str; 3]) -> Scene {
    let mut scene = Scene::new(title, drawing::around(&[found.circle], 0.12));
    for corners in &run.ground {
        scene.area(*corners, Fill::Domain);
    }
    scene.area(found.corners, Fill::Triangle);
    drawing::edges(&mut scene, run);
    let [a, b, c] = found.corners;
    scene.line([a, b, c, a], Pen::Triangle);
    drawing::segments(&mut scene, &run.case.domain);
    scene.circle(found.circle, Pen::Circumcircle);
    scene.line([found.circle.centre, c], Pen::Sight);
    drawing::other_centres(&mut scene, run, &found.corners);
    for (corner, name) in found.corners.into_iter().zip(names) {
        scene.named_point(corner, Mark::Centre, name);
    }
    scene.named_point(found.circle.centre, Mark::Place, "c");
    scene
}

impl Figure4<'_> {
    fn scenes(&self) -> Vec<Scene> {
        let (run, found) = &self.seen;
        let mut first = scene(run, "(a) sees its circumcentre", found, ["p", "q", "r"]);
        first.circle(self.covering, Pen::Biting);
        if !found.corners.contains(&self.covering.centre) {
            first.named_point(self.covering.centre, Mark::Centre, "x");
        }
        let (run, found) = &self.cut_off;
        let second = scene(
            run,
            "(b) cut off from it by the boundary",
            found,
            ["x = p_1", "z = p_2", "y"],
        );
        let (run, found) = &self.cut_off_inside;
        let third = scene(run, "(c) cut off, though it is in the domain", found, ["p", "q", "r"]);
        vec![first, second, third]
    }

    fn caption(&self) -> String {
        let ((a, first), (b, second), (c, third)) = (&self.seen, &self.cut_off, &self.cut_off_inside);
        let largest = |found: &Obtuse| angles_deg(found.corners)[2];
        format!(
            "Triangles of the mesh: (a) a triangle pqr of the first subset: all of it is visible from its circumcentre c, which lies \
             in a biting circle B(x, c_b f(x)) (solid); (b) a triangle xyz of the second subset: the boundary piece p₁p₂ cuts it off \
             from c; (c) a triangle pqr of the second subset although its circumcentre c is in the domain. Dashed: the circumcircle, \
             in which no mesh vertex lies.\n\n\
             The largest angles are {}°, {}° and {}°; the circumradii {}, {} and {}. Of {} triangles in all runs searched, {} have an \
             angle over {}° and see their circumcentre, {} are cut off from one outside the domain, and {} from one inside.\n\n\
             (c) can occur only across a segment that has the domain on both sides, as here, if t ≤ 1/3, c_b + t ≤ 1 and no angle is \
             under 90°. For let w be the point of p₁p₂ nearest to c. By Lemmas 6.5 and 6.6 c lies at most 5‖p₁p₂‖/8 − h_r ≤ \
             3‖p₁p₂‖/8 ≤ 3(3 + t)/16 · c_b f(p₁) behind it, while lfs(w) ≥ f(w) ≥ (1 − 3t/2 − t²/2) f(p₁), which is more. So no segment \
             behind which the domain begins again lies between w and c: one that is not incident to that of p₁p₂ is farther \
             away, and one that is does not reach before it. Among all runs, {} of the {} triangles of sort (c) are cut off by a \
             segment with the domain on one side. {} further ones have vertices in their circumcircles, across a segment that is no edge \
             of the Delaunay triangulation and had to be forced into the mesh, of which the paper knows nothing; they are left out.\n\n\
             Drawn (a) from {}; (b) from {}; (c) from {}. Each is the one of its sort whose circumcentre lies deepest behind its longest \
             side, as a share of the circumradius.",
            short(largest(first)),
            short(largest(second)),
            short(largest(third)),
            short(first.circle.radius),
            short(second.circle.radius),
            short(third.circle.radius),
            self.triangles,
            self.counts[0],
            OBTUSE_DEG,
            self.counts[1],
            self.counts[2],
            self.one_sided,
            self.counts[2],
            self.forced,
            a.told(),
            b.told(),
            c.told()
        )
    }

    /// Picture, caption and numbers.
    pub fn drawing(&self) -> Drawing<'static> {
        let numbers = |(run, found): &(&Run, Obtuse)| {
            let numbers = Numbers::default().run(run).points("corners", &found.corners);
            numbers
                .disc("circumcircle", &found.circle)
                .with("is_in_domain", found.is_inside)
        };
        Drawing {
            picture: Picture::Sheet(Sheet {
                columns: 3,
                scenes: self.scenes(),
            }),
            caption: self.caption(),
            numbers: Numbers::default()
                .with("a", numbers(&self.seen).disc("covering", &self.covering))
                .with("b", numbers(&self.cut_off))
                .with("c", numbers(&self.cut_off_inside))
                .with("counts", self.counts.to_vec())
                .with("cut_off_by_one_sided", self.one_sided)
                .with("left_out_as_forced", self.forced),
            commands: [&self.seen, &self.cut_off, &self.cut_off_inside]
                .map(|(run, _)| run.asked.command())
                .to_vec(),
        }
    }
}
