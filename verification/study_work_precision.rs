//! Study `work-precision`: what an error costs.
fn main() -> std::process::ExitCode {
    lahar::verify::study::main(&lahar::verify::claims::work_precision::STUDY, &lahar::solver::plain::Plain)
}
