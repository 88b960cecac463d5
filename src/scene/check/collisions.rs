//! Names of columns and files that would meet. Some systems and tools do not tell capital letters from small ones.

use std::collections::HashMap;

use crate::scene::checker::Checker;
use crate::scene::series::Listed;
use crate::scene::{SceneError, SceneProblem};

/// Whether all probes of a run have columns and plots of their own.
pub(in crate::scene) fn check(at: &Checker, probes: &[Listed]) -> Result<(), SceneError> {
    let mut columns = HashMap::from([("time".to_owned(), None)]);
    let mut plots = HashMap::new();
    for listed in probes {
        for column in listed.columns() {
            claim(at, &mut columns, listed, "the column", &column.name(&listed.probe.name))?;
        }
        let of_columns = listed.plots().into_iter().map(|(file, _)| file);
        for file in of_columns.chain(listed.file_plot()) {
            claim(at, &mut plots, listed, "the plot", &file)?;
        }
    }
    Ok(())
}

/// Takes a name for a probe unless another one has it, or everybody (`None`).
fn claim<'a>(
    at: &Checker,
    taken: &mut HashMap<String, Option<&'a Listed>>,
    by: &'a Listed,
    what: &'static str,
    name: &str,
) -> Result<(), SceneError> {
    let Some(other) = taken.insert(name.to_lowercase(), Some(by)) else { return Ok(()) };
    let path = by.path.as_ref().or(other.and_then(|other| other.path.as_ref()));
    let problem = SceneProblem::NamesCollide {
        what,
        name: name.to_owned(),
        by: by.probe.name.clone(),
        other: other.map(|other| other.probe.name.clone()),
    };
    at.fail(path.cloned().unwrap_or_default(), problem)
}
