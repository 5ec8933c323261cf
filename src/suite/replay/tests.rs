use crate::geometry::DVec2;
use crate::geometry::segments::closest_on_segment;
use crate::suite::replay::record::Queue;
use crate::suite::replay::*;
use std::fs;

/// A page may be so large.
const MOST_BYTES: usize = 3_000_000;

fn cell(domain: &str, params: &[(&str, &str)]) -> Cell {
    Cell::new(domain, "biting", "lfs", 0.25, 0.75).with(params)
}

fn recorded(domain: &str, params: &[(&str, &str)]) -> Recording {
    recording(&cell(domain, params)).expect("a recording")
}

/// The recording that a page carries.
fn carried(page: &str) -> Recording {
    let (_, after) = page.split_once("type=\"application/json\">").expect("data");
    let (data, _) = after.split_once("</script>").expect("its end");
    serde_json::from_str(data).expect("a recording")
}

fn point(recording: &Recording, vertex: u32) -> DVec2 {
    let place = 2 * vertex as usize;
    DVec2::new(recording.points[place] as f64, recording.points[place + 1] as f64)
}

fn circle(recording: &Recording, bite: usize) -> (DVec2, f64) {
    let bites = &recording.bites;
    (point(recording, bites.centres[bite]), bites.radii[bite] as f64)
}

fn count(recording: &Recording, letter: char) -> usize {
    recording.bites.reasons.matches(letter).count()
}

#[test]
fn a_page_carries_the_run() {
    let recording = recorded("plate-hole", &[]);
    let read = carried(&page(&recording).expect("a page"));
    assert_eq!(read, recording);
    let (bites, queue) = (&read.bites, &read.queue);
    let all = bites.reasons.len();
    assert_eq!(
        [bites.centres.len(), bites.radii.len(), queue.appearing.len()],
        [all; 3]
    );
    assert_eq!(count(&read, 'V'), 68, "every input vertex is bitten");
    assert_eq!(bites.segments.len(), count(&read, 'B') + count(&read, 'M'));
    assert_eq!(bites.parents.len(), count(&read, 'B') + 2 * count(&read, 'M'));
    assert_eq!(bites.middles.len(), 4 * count(&read, 'M'));
    assert_eq!(bites.chosen.len(), count(&read, 'F'));
    assert!(read.triangles.len() > all && read.points.len() == 2 * all);
    let seen = queue.appearing.iter().map(|&n| n as usize).sum::<usize>();
    assert_eq!([queue.gone.len(), queue.turns.len(), queue.ranks.len()], [seen; 3]);
    assert_eq!([queue.points.len(), queue.circles.len()], [2 * seen; 2]);
}

#[test]
fn labels_name_the_circles_that_the_paper_names() {
    for domain in ["plate-hole", "l-shape", "comb"] {
        let recording = recorded(domain, &[]);
        let bites = &recording.bites;
        let (mut parents, mut middles) = (bites.parents.iter(), bites.middles.chunks(4));
        for (bite, letter) in bites.reasons.chars().enumerate() {
            let q = circle(&recording, bite).0;
            let ends = match letter {
                'B' => vec![q],
                'M' => {
                    let middle = middles.next().expect("q1 and q2");
                    let ends = middle.chunks(2).map(|xy| DVec2::new(xy[0] as f64, xy[1] as f64));
                    ends.collect()
                }
                _ => continue,
            };
            assert!(
                letter == 'B' || q.distance(0.5 * (ends[0] + ends[1])) < 2.0,
                "q is the middle"
            );
            for end in ends {
                let parent = *parents.next().expect("p1 or p2");
                assert!(
                    (0..bite as i64).contains(&parent),
                    "{domain} {bite}: p is bitten before q"
                );
                let (centre, radius) = circle(&recording, parent as usize);
                assert!(
                    (end.distance(centre) - radius).abs() < 3.0,
                    "{domain} {bite}: on its circle"
                );
            }
        }
    }
}

#[test]
fn the_chosen_front_vertex_is_first_in_line() {
    for order in ["largest", "fifo", "lifo", "sharpest", "equilateral"] {
        let recording = recorded("l-shape", &[("order", order)]);
        let Queue { turns, gone, .. } = &recording.queue;
        let mut since = Vec::new();
        for (bite, &appearing) in recording.queue.appearing.iter().enumerate() {
            since.extend(std::iter::repeat_n(bite, appearing as usize));
        }
        let mut chosen = recording.bites.chosen.iter().map(|&serial| serial as usize);
        for (bite, _) in recording.bites.reasons.match_indices('F') {
            let serial = chosen.next().expect("a front vertex");
            let waits = |other: &usize| since[*other] < bite && gone[*other] as usize >= bite;
            assert!(waits(&serial) && gone[serial] as usize == bite);
            let first = (0..gone.len()).filter(waits).min_by_key(|&other| turns[other]);
            assert_eq!(first, Some(serial), "{order} {bite}");
        }
        assert!(
            gone.iter().all(|&bite| (bite as usize) < recording.bites.reasons.len()),
            "the front is empty in the end"
        );
    }
    let drawn = recorded("l-shape", &[("order", "random")]);
    assert!(drawn.queue.turns.is_empty() && drawn.queue.ranks.is_empty());
}

#[test]
fn rings_enclose_the_domain() {
    for domain in ["plate-hole", "star", "interface", "random-pslg:kind=islands,seed=1"] {
        let recording = recorded(domain, &[]);
        let outline = &recording.outline;
        let area = |ring: &[u32]| {
            let next = ring.iter().cycle().skip(1);
            let twice: f64 = ring
                .iter()
                .zip(next)
                .map(|(&one, &other)| point(&recording, one).perp_dot(point(&recording, other)))
                .sum();
            0.5 * twice.abs()
        };
        let meshed: f64 = recording.triangles.iter().map(|triangle| area(triangle)).sum();
        let mut areas: Vec<f64> = outline.rings.iter().map(|ring| area(ring)).collect();
        areas.sort_by(f64::total_cmp);
        if areas.len() <= 2 {
            let holes: f64 = areas.iter().rev().skip(1).sum();
            let outer = areas.last().copied().unwrap_or_default();
            assert!(
                (outer - holes - meshed).abs() < 1e-4 * outer,
                "{domain}: {outer} {holes} {meshed}"
            );
        }
        let corners = outline.rings.iter().map(Vec::len).sum::<usize>();
        assert!(corners <= outline.segments.len() && corners >= 3, "{domain}");
    }
}

#[test]
fn corners_cut_off_are_left_out_of_the_front() {
    let recording = recorded("star", &[]);
    let outline = &recording.outline;
    assert!(outline.corners.len() >= 5 && count(&recording, 'C') >= 10);
    let tips: Vec<u32> = (0..10).filter(|v| !recording.bites.centres.contains(v)).collect();
    assert_eq!(tips.len(), 5, "the five tips get no circle");
    assert!(outline.front.iter().flatten().all(|end| !tips.contains(end)));
    assert_eq!(
        outline.front.len(),
        10 + outline.corners.len(),
        "what is left of the segments, and the bases of the corners"
    );
    let whole = recorded("star", &[("corners", "bite")]).outline;
    assert!(whole.corners.is_empty() && whole.front == whole.segments);
}

#[test]
fn circles_do_not_show_beyond_notches() {
    let recording = recorded("naca0012", &[]);
    let shadows = &recording.outline.shadows;
    assert!(!shadows.is_empty(), "the trailing edge is a notch of 16.5°");
    for &[bite, vertex, end] in shadows {
        let (centre, radius) = circle(&recording, bite as usize);
        let (vertex, end) = (point(&recording, vertex), point(&recording, end));
        assert!(
            closest_on_segment([vertex, end], centre).distance(centre) <= radius + 1.0,
            "the circle reaches the side"
        );
        assert!(
            (vertex - centre).perp_dot(end - centre).abs() > 0.0,
            "which is not one that it is centred on"
        );
    }
    assert!(recorded("plate-hole", &[]).outline.shadows.is_empty());
}

#[test]
fn a_page_needs_nothing_else_and_is_small() {
    let page = page(&recorded("plate-hole", &[])).expect("a page");
    for stranger in [
        "http:", "https:", "src=", "@import", "url(", "fetch(", "XMLHttp", "{{s", "{{data",
    ] {
        assert!(!page.contains(stranger), "{stranger}");
    }
    assert!(page.len() < MOST_BYTES, "{} bytes", page.len());
    assert_eq!(page.matches("</script>").count(), 2, "data and script");
    assert_eq!(page.matches("</style>").count(), 1);
}

#[test]
fn no_text_of_a_run_ends_the_element_it_stands_in() {
    let mut recording = recorded("unit-square", &[]);
    recording.about.domain = "</script><script>alert(1)</script><!-- {{script}}".into();
    let page = page(&recording).expect("a page");
    assert_eq!(page.matches("</script>").count(), 2);
    assert!(!page.contains("<script>alert") && !page.contains("<!--"));
    assert_eq!(carried(&page), recording);
}

#[test]
fn the_command_of_a_page_is_quoted_for_a_shell() {
    let mut asked = cell("l-shape", &[("order", "fifo")]);
    asked.spacing = "expr:0.1 + 0.2*x".into();
    asked.lfs_cap = false;
    assert_eq!(
        recording(&asked).expect("a recording").about.command,
        "cargo run --release -- figures --replay l-shape --spacing 'expr:0.1 + 0.2*x' --t 0.25 --c-b 0.75 --seed 0 --param order=fifo \
         --no-lfs-cap"
    );
}

#[test]
fn what_cannot_be_replayed_is_told() {
    let mut other = cell("unit-square", &[]);
    other.mesher = "delaunay-refinement".into();
    assert!(matches!(recording(&other), Err(ReplayError::Input(text)) if text.contains("delaunay-refinement")));
    let mut fine = cell("unit-square", &[]);
    fine.spacing = "uniform:0.001".into();
    let error = recording(&fine).expect_err("too many bites").to_string();
    assert!(error.contains("20000") && error.contains("larger"), "{error}");
    let nowhere = write(Path::new("/dev/null"), &cell("unit-square", &[]));
    assert!(matches!(nowhere, Err(ReplayError::Input(text)) if text.contains("replay-unit-square.html")));
}

#[test]
fn the_committed_replay_is_what_is_written_now() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = write(folder.path(), &cell("plate-hole", &[])).expect("a page");
    let committed = Path::new(env!("CARGO_MANIFEST_DIR"))
        .join("paper")
        .join("replay-plate-hole.html");
    let [written, committed] = [path, committed].map(|path| fs::read_to_string(path).expect("a page"));
    assert!(written == committed, "stale: run {}", carried(&written).about.command);
    for page in fs::read_dir(Path::new(env!("CARGO_MANIFEST_DIR")).join("paper")).expect("a folder") {
        let path = page.expect("an entry").path();
        let name = path.file_name().unwrap_or_default().to_string_lossy().into_owned();
        if name.starts_with("replay-") {
            let text = fs::read_to_string(&path).expect("a page");
            assert!(text.len() < MOST_BYTES, "{name} has {} bytes", text.len());
            let again = page_of(&carried(&text));
            assert!(again == text, "{name} was not written by this code");
        }
    }
}

fn page_of(recording: &Recording) -> String {
    page(recording).expect("a page")
}
