//! Study `work-precision`: what an error costs.
fn main() -> std::process::ExitCode {
    lahar_verification::study::main(
        &lahar_verification::claims::work_precision::STUDY,
        &lahar::solver::plain::Plain,
    )
}
