use crate::suite::run::plan::*;

const PLAN: &str = r#"
    question = "What comes out?"
    [budget]
    triangles = 1000
    [expect]
    certificate_holds = true
    certificate_whole_up_to_t = "1/3"
    measured_per_domain = { comb = 2 }
    [[group]]
    name = "grid"
    domains = ["unit-square", "comb"]
    spacings = ["lfs", "uniform:0.1"]
    mesher = "biting"
    t = [0.25, "1/3"]
    c_b = [0.5, 1]
    quick = { domains = ["comb"], t = [0.25] }
    [[group]]
    name = "time"
    domains = ["unit-square"]
    spacings = ["lfs"]
    mesher = "biting"
    params = [{ order = "fifo" }]
    t = [0.25]
    c_b = [1.0]
    timed = true
"#;

fn read(text: &str) -> Result<Plan, PlanError> {
    let folder = tempfile::tempdir().expect("a folder");
    let file = folder.path().join("try.toml");
    std::fs::write(&file, text).expect("written");
    Plan::read(&file)
}

#[test]
fn cells_are_all_combinations_in_order() {
    let plan = read(PLAN).expect("a plan");
    let cells = plan.cells().expect("cells");
    assert_eq!((plan.name.as_str(), cells.len()), ("try", 17));
    assert_eq!(cells[0].key, "grid/unit-square/lfs/biting/t=0.25/c_b=0.5");
    assert_eq!(cells[3].cell.t, 1.0 / 3.0);
    assert_eq!(
        cells[16].key,
        "time/unit-square/lfs/biting,order=fifo/t=0.25/c_b=1/timed"
    );
    assert_eq!((cells[0].repeats, cells[16].repeats), (1, 3));
    assert_eq!(cells[0].budget.triangles, 1000.0);
}

#[test]
fn quick_is_a_part_of_the_whole() {
    let plan = read(PLAN).expect("a plan");
    let whole: BTreeSet<String> = plan.cells().expect("cells").into_iter().map(|cell| cell.key).collect();
    let quick = plan.into_quick();
    let cells = quick.cells().expect("cells");
    assert_eq!((quick.name.as_str(), cells.len()), ("try-quick", 4));
    assert!(cells.iter().all(|cell| whole.contains(&cell.key)));
    assert!(quick.expect.measured_per_domain.is_empty() && quick.expect.certificate_holds);
}

#[test]
fn several_meshers_stand_in_one_group() {
    let methods = r#"methods = [
        { mesher = "biting" },
        { mesher = "another", params = { complete = true, oversample = 4 } },
    ]
    equal_triangles = 20_000"#;
    let plan = read(&PLAN.replacen("mesher = \"biting\"", methods, 1)).expect("a plan");
    let cells = plan.cells().expect("cells");
    assert_eq!(cells.len(), 33);
    assert_eq!(
        cells[4].key,
        "grid/unit-square/lfs/another,complete=true,oversample=4/t=0.25/c_b=0.5/triangles=20000"
    );
    assert_eq!(
        (cells[0].cell.triangles, cells[32].cell.triangles),
        (Some(20_000), None)
    );
    assert_eq!(cells[4].cell.scaled_to(1.0).t, 0.5);
}

#[test]
fn groups_share_lists_of_methods() {
    let shared = r#"
    [methods]
    two = [{ mesher = "biting" }, { mesher = "another" }]
    one = [{ mesher = "another" }]
    [[group]]"#;
    let text = PLAN
        .replacen("mesher = \"biting\"", "methods = \"two\"", 1)
        .replacen("    [[group]]", shared, 1)
        .replacen("t = [0.25] }", "t = [0.25], methods = \"one\" }", 1);
    let plan = read(&text).expect("a plan");
    let count = |plan: &Plan, mesher: &str| {
        let cells = plan.cells().expect("cells");
        cells.iter().filter(|planned| planned.cell.mesher == mesher).count()
    };
    assert_eq!((count(&plan, "biting"), count(&plan, "another")), (17, 16));
    let quick = plan.into_quick();
    assert_eq!((count(&quick, "biting"), count(&quick, "another")), (0, 4));
    let unknown = read(&text.replacen("\"two\"", "\"three\"", 1))
        .expect_err("no such list")
        .to_string();
    assert!(unknown.contains("no list `three`"), "{unknown}");
}

#[test]
fn counts_threads_and_a_problem_are_part_of_a_cell() {
    let lists = "timed = true\nequal_triangles = [100, 200]\nthreads = [1, 2]\npoisson = \"smooth\"";
    let plan = read(&PLAN.replacen("timed = true", lists, 1)).expect("a plan");
    let cells = plan.cells().expect("cells");
    let keys: Vec<&str> = cells[16..].iter().map(|planned| planned.key.as_str()).collect();
    let base = "time/unit-square/lfs/biting,order=fifo/t=0.25/c_b=1";
    let expected = [(100, ""), (100, "/threads=2"), (200, ""), (200, "/threads=2")]
        .map(|(count, threads)| format!("{base}/triangles={count}{threads}/poisson=smooth/timed"));
    assert_eq!(keys, expected);
    assert_eq!(cells[17].cell.threads, 2);
    let unknown = read(&PLAN.replacen("timed = true", "timed = true\npoisson = \"rough\"", 1));
    let told = unknown.expect_err("no such problem").to_string();
    assert!(told.contains("`rough`") && told.contains("smooth"), "{told}");
}

#[test]
fn mistakes_are_named_with_file_and_place() {
    for (from, to, expected) in [
        (
            "t = [0.25, \"1/3\"]",
            "t = [0.25, \"a third\"]",
            "`a third` is no number",
        ),
        ("t = [0.25, \"1/3\"]", "t = [0.25, -1]", "must be positive"),
        ("t = [0.25, \"1/3\"]", "t = []", "group `grid` has an empty list"),
        ("t = [0.25, \"1/3\"]", "t = [0.25, 0.25]", "twice"),
        ("timed = true", "timd = true", "line 25"),
        (
            "timed = true",
            "timed = true\nsections = [\"angel\"]",
            "`angel`, expected one of `angle`, `size`",
        ),
        (
            "question",
            "about = \"nibbling\"\nquestion",
            "none of the meshers of its groups: biting",
        ),
        (
            "question",
            "headline = [\"orders\"]\nquestion",
            "`headline` has `orders`, but its page has angle, size, fewest, certificate",
        ),
        ("question", "qestion", "line 2"),
        ("timed = true", "timed = true\nrepeats = 0", "at least 1"),
        ("mesher = \"biting\"", "", "say `mesher`"),
        (
            "mesher = \"biting\"",
            "mesher = \"biting\"\nmethods = [{ mesher = \"biting\" }]",
            "or else `methods`",
        ),
    ] {
        let message = read(&PLAN.replacen(from, to, 1)).expect_err(to).to_string();
        assert!(
            message.contains("try.toml: ") && message.contains(expected),
            "{to}: {message}"
        );
    }
    let missing = Plan::read(Path::new("no/such.toml")).expect_err("missing").to_string();
    assert!(
        missing.contains("no/such.toml") && missing.contains("biting list"),
        "{missing}"
    );
}

#[test]
fn lists_that_combine_to_more_cells_than_memory_holds_are_refused() {
    let numbers = |count: usize| (1..=count).map(|k| k.to_string()).collect::<Vec<_>>().join(", ");
    let many = numbers(2000);
    let text = format!(
        "question = \"?\"\n[[group]]\nname = \"g\"\ndomains = [\"comb\"]\nspacings = [\"lfs\"]\nmesher = \"biting\"\n\
         t = [{many}]\nc_b = [{many}]\nseeds = [{many}]\n"
    );
    let problem = read(&text).expect_err("too many cells").problem;
    assert_eq!(
        problem,
        "the lists combine to 8000000000 cells; at most 1000000 are run"
    );
}

#[test]
fn the_page_shows_what_is_named_or_else_what_varies() {
    let shown = |text: &str| {
        let sections = read(text).expect("a plan").sections;
        let line = |(section, groups): (&Section, &BTreeSet<String>)| {
            let groups: Vec<&str> = groups.iter().map(String::as_str).collect();
            format!("{section}: {}", groups.join(" "))
        };
        let asked = sections.iter().filter(|(section, _)| **section != Section::Certificate);
        asked.map(line).collect::<Vec<_>>()
    };
    assert_eq!(shown(PLAN), ["angle: grid", "size: grid", "fewest: grid"]);
    let of_plan = PLAN.replacen("question", "sections = [\"size\"]\nquestion", 1);
    assert_eq!(shown(&of_plan), ["size: grid time"]);
    let of_group = of_plan.replacen("timed = true", "sections = [\"time\", \"orders\"]\ntimed = true", 1);
    assert_eq!(shown(&of_group), ["size: grid", "orders: time", "time: time"]);
    for (from, to, expected) in [
        (
            "spacings = [\"lfs\"]",
            "spacings = [\"uniform:1\", \"uniform:2\"]",
            "time: time",
        ),
        ("{ order = \"fifo\" }", "{ order = \"fifo\" }, {}", "orders: time"),
        ("{ order = \"fifo\" }", "{ rule = \"later\" }, {}", "rules: time"),
        ("{ order = \"fifo\" }", "{ corners = \"bite\" }, {}", "corners: time"),
        ("timed = true", "threads = [1, 2]", "threads: time"),
        ("timed = true", "poisson = \"corner\"", "poisson: time"),
        (
            "timed = true",
            "poisson = \"corner\"\nadapt = [{ eps = 0.01 }]",
            "adaptation: time",
        ),
    ] {
        let sections = shown(&PLAN.replacen(from, to, 1));
        assert!(sections.contains(&expected.to_owned()), "{to}: {sections:?}");
    }
    let methods = "methods = [{ mesher = \"biting\" }, { mesher = \"triangle\" }]";
    let contest = shown(&PLAN.replacen("mesher = \"biting\"", methods, 1));
    assert_eq!(
        contest[3..],
        ["methods: grid", "peers: grid", "tasks: grid", "duels: grid"]
    );
}

#[test]
fn a_plan_is_about_the_mesher_it_names_or_its_first() {
    let two = PLAN.replacen(
        "mesher = \"biting\"",
        "methods = [{ mesher = \"another\" }, { mesher = \"biting\" }]",
        1,
    );
    assert_eq!(read(&two).expect("a plan").about, "another");
    let named = two.replacen("question", "about = \"biting\"\nquestion", 1);
    assert_eq!(read(&named).expect("a plan").about, "biting");
}
