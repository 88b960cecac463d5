//! Study `coupling`: grains and fluid, each pushing the other; books, lubrication, free surface.
fn main() -> std::process::ExitCode {
    lahar::verify::study::main(&lahar::verify::claims::coupling::STUDY, &lahar::solver::choose::Best)
}
