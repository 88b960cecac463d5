//! The most memory a process holds while it runs a scene into a folder, against what `plan` says. One test
//! only: the figure belongs to the whole process.

use std::path::Path;

use lahar::plan::{Plan, Planned};
use lahar::run::{self, Options};
use lahar::scene;
use lahar::solver::choose::Best;

/// Largest resident size of this process so far, bytes; `None` where the system does not say.
fn peak() -> Option<u64> {
    let text = std::fs::read_to_string("/proc/self/status").ok()?;
    let line = text.lines().find_map(|line| line.strip_prefix("VmHWM:"))?;
    line.trim().strip_suffix("kB")?.trim().parse::<u64>().ok()?.checked_mul(1024)
}

/// What may be held above the plan: program, stacks, series, buffers.
const MARGIN: f64 = 1.15;

#[test]
fn peak_is_what_the_plan_says() {
    // In the order of their size: a peak does not go down. Spacings give 90³ cells, most of them empty, and 80³.
    for (name, spacing_m) in [("show/slump_cone", 0.002), ("verify/taylor_green_3d", 0.00125)] {
        let path = Path::new(env!("CARGO_MANIFEST_DIR")).join(format!("scenes/{name}.json"));
        let mut scene = scene::load_flow(&path).unwrap_or_else(|error| panic!("{error}"));
        scene.domain.spacing_m = spacing_m;
        let plan = Plan::new(&scene).unwrap_or_else(|error| panic!("{error}"));
        let out = Path::new(env!("CARGO_TARGET_TMPDIR")).join("peak_memory");
        let _ = std::fs::remove_dir_all(&out);
        let (until_s, bytes) = (Some(2.0 * plan.numbers.time_step_s), plan.numbers.bytes);
        let planned = Planned::Flow(Box::new(scene), Box::new(plan));
        let options = Options { threads: 2, until_s, ..Options::new(out.clone(), &Best) };
        run::run(&planned, &options).unwrap_or_else(|error| panic!("{error}"));
        let _ = std::fs::remove_dir_all(&out);
        let Some(peak) = peak() else { return };
        let ratio = peak as f64 / bytes as f64;
        println!("{name}: peak of {peak} bytes, {ratio:.3} of the plan");
        // Below one half the plan would turn away what fits.
        assert!((0.5..=MARGIN).contains(&ratio), "{name}: {ratio}");
    }
}
