//! What a shell wants to know of the program: completions and man pages, made from its arguments.

use std::path::Path;

use agglo::record::{RecordError, atomic};
use clap::{Command, CommandFactory};
use clap_complete::Shell;
use clap_mangen::Man;

use crate::arguments::Arguments;
use crate::{Failure, print};

/// Prints the completions of a shell.
pub(crate) fn completions(shell: Shell) -> Result<(), Failure> {
    let mut script = Vec::new();
    clap_complete::generate(shell, &mut Arguments::command(), "agglo", &mut script);
    print(&String::from_utf8_lossy(&script))
}

/// Prints the program's man page, or writes it and those of all verbs into a folder.
pub(crate) fn man(folder: Option<&Path>) -> Result<(), Failure> {
    let program = program();
    let Some(folder) = folder else {
        return print(&String::from_utf8_lossy(&page(program)?));
    };
    std::fs::create_dir_all(folder).map_err(|error| {
        Failure::bad_input(format!("error: cannot make the folder {}: {error}", folder.display()))
    })?;
    let verbs: Vec<Command> = program.get_subcommands().cloned().collect();
    let mut written: Vec<String> = Vec::new();
    for command in std::iter::once(program).chain(verbs) {
        let command = command.version(env!("CARGO_PKG_VERSION"));
        let path = folder.join(Man::new(command.clone()).get_filename());
        atomic::write(&path, &page(command)?).map_err(|error| unwritten(&error))?;
        written.push(path.display().to_string());
    }
    print(&written.join("\n"))
}

/// The program with its verbs named as their pages are, without the verb `help`, which needs none.
fn program() -> Command {
    let mut program = Arguments::command().disable_help_subcommand(true);
    program.build();
    program
}

fn page(command: Command) -> Result<Vec<u8>, Failure> {
    let mut page = Vec::new();
    // The same page whenever and from whichever verb it is made: no date, one source.
    let source = concat!("agglo ", env!("CARGO_PKG_VERSION"));
    let rendered = Man::new(command).date("").source(source).render(&mut page);
    rendered.map_err(|error| Failure::failed(format!("error: cannot make a man page: {error}")))?;
    Ok(page)
}

fn unwritten(error: &RecordError) -> Failure {
    Failure::failed(format!("error: {error}"))
}
