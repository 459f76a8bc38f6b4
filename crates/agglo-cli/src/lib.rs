//! The program `agglo`: arguments, progress, messages and exit codes. All physics is in the library. Others start it as well,
//! such as the package for Python.
//!
//! Exit codes: 0 done, 1 a run failed or was interrupted, 2 bad input, 3 stopped at the given wall time.

#[cfg(test)]
#[macro_use]
extern crate agglo_testing;

mod arguments;
mod brake;
mod campaign_plan;
mod explain;
mod failure;
mod hand_over;
mod json;
mod laws;
mod manuals;
mod progress;
mod read;
mod render;
mod report;
mod run;
mod search;
mod session;
mod signals;
#[cfg(feature = "watch")]
mod watch;

use std::ffi::OsString;
use std::io::{self, Write};
use std::path::Path;

use agglo::forecast::Plan;
use agglo::scenario::{TEMPLATES, nearest_template, schema, template};
use agglo::search::campaign_schema;
use agglo::text::visible;
use clap::Parser;

use arguments::{Arguments, Verb};
pub(crate) use failure::Failure;
use read::{Kind, Source};

/// Does what the arguments of the program say, the first of which is its name; gives its exit code. It prints, hears
/// signals and takes the threads of the whole process.
pub fn act_on(arguments: impl IntoIterator<Item = OsString>) -> u8 {
    signals::outlive_file_limits();
    let verb = match Arguments::try_parse_from(arguments) {
        Ok(arguments) => arguments.verb,
        // The page of help as well, which is no failure.
        Err(told) => {
            let _ = told.print();
            return u8::try_from(told.exit_code()).unwrap_or(2);
        }
    };
    let is_json = verb.is_json();
    let outcome = run::use_threads(verb.threads()).and_then(|()| act(verb));
    let Err(failure) = outcome else { return 0 };
    if is_json {
        json::tell(&failure);
    } else {
        failure.tell();
    }
    failure.code
}

fn act(verb: Verb) -> Result<(), Failure> {
    match verb {
        Verb::New { template } => new(&template),
        Verb::Check { scenario, settings, from, json } => check(&scenario, settings, from.as_deref(), json),
        Verb::Explain { word } => explain::explain(word.as_deref()),
        Verb::ListLaws(form) => laws::list(form),
        Verb::Completions { shell } => manuals::completions(shell),
        Verb::Man { output } => manuals::man(output.as_deref()),
        Verb::Schema { search } => print(&format!("{:#}", if search { campaign_schema() } else { schema() })),
        Verb::Report { folder } => report::report(&folder),
        Verb::Cite { folder, bibtex } => report::cite(&folder, bibtex),
        Verb::Run(options) => run::run(&options),
        Verb::Search(options) => search::conduct(&options, Kind::Search, None),
        Verb::Study(options) => search::study(&options),
        Verb::Join(options) => search::join(&options),
        Verb::HandOver(options) => hand_over::hand_over(&options),
        #[cfg(feature = "watch")]
        Verb::Watch { folder } => watch::watch(&folder),
        Verb::Render(options) => render::render(&options),
        Verb::Resume(options) if agglo::search::campaign::is_one(&options.folder) => search::resume(&options),
        Verb::Resume(options) => run::resume(&options),
    }
}

/// Writes to the standard error, without what acts on a terminal. Work goes on where nobody reads its messages.
pub(crate) fn tell(text: &str) {
    let _ = writeln!(io::stderr(), "{}", visible(text));
}

/// Writes to the standard output, without what acts on a terminal; a reader that closed the pipe has seen enough.
pub(crate) fn print(text: &str) -> Result<(), Failure> {
    match writeln!(io::stdout(), "{}", visible(text.trim_end())) {
        Err(error) if error.kind() != io::ErrorKind::BrokenPipe => {
            Err(Failure::failed(format!("error: cannot write: {error}")))
        }
        _ => Ok(()),
    }
}

fn new(name: &str) -> Result<(), Failure> {
    if let Some(found) = template(name) {
        return print(found.text);
    }
    let known: Vec<String> =
        TEMPLATES.iter().map(|known| format!("  {:<20}{}", known.name, known.title)).collect();
    let advice = nearest_template(name).map(|near| format!("; did you mean \"{near}\"?")).unwrap_or_default();
    let known = known.join("\n");
    Err(Failure::bad_input(format!("error: there is no template \"{name}\"{advice}\n{known}")))
}

fn check(file: &Path, settings: Vec<String>, from: Option<&Path>, is_json: bool) -> Result<(), Failure> {
    let source = Source::read(file)?;
    if source.kind() != Kind::Scenario {
        if from.is_some() {
            source.refuse_other_kind(Kind::Scenario)?;
        }
        return campaign_plan::check(&source, &settings, is_json);
    }
    let scenario = source.scenario(&run::starting_from(settings, from)?)?;
    let plan = Plan::new(&scenario, &source.base)
        .map_err(|error| Failure::bad_input(format!("error: {}: {error}", source.shown)))?;
    if is_json {
        let (file, kind, run) = (source.shown.as_str(), "scenario", Some(&plan));
        return json::Line::Plan { file, kind, run, campaign: None }.print();
    }
    print(&format!("{} is valid\n{plan}", source.shown))
}
