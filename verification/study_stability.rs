//! Study `stability`: von Neumann analysis and runs driven unstable on purpose.
fn main() -> std::process::ExitCode {
    lahar::verify::study::main(&lahar::verify::claims::stability::STUDY, &lahar::solver::choose::Best)
}
