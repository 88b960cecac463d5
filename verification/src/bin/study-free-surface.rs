//! Study `free-surface`: mass tracking, rest, ledgers, symmetry, loads.
fn main() -> std::process::ExitCode {
    lahar_verification::study::main(
        &lahar_verification::claims::free_surface::STUDY,
        &lahar::solver::choose::Best,
    )
}
