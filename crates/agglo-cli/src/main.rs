//! The program `agglo`.

use std::process::ExitCode;

fn main() -> ExitCode {
    ExitCode::from(agglo_cli::act_on(std::env::args_os()))
}
