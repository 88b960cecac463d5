//! Study `free-surface`: mass tracking, rest, ledgers, symmetry, loads.
fn main() -> std::process::ExitCode {
    lahar::verify::study::main(&lahar::verify::claims::free_surface::STUDY, &lahar::solver::choose::Best)
}
