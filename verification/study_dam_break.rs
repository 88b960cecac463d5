//! Study `dam-break`: flows released on the horizontal and on slopes.
fn main() -> std::process::ExitCode {
    lahar::verify::study::main(&lahar::verify::claims::dam_break::STUDY, &lahar::solver::choose::Best)
}
