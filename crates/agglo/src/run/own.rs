//! What the recorder keeps of a caller's own measures and rule: their table, and what is still to be looked at.

use serde::{Deserialize, Serialize};

use super::guests::{Known, Look, Onlooker};
use super::job::Job;
use crate::folder::{Mark, RunFolder, names};
use crate::record::columns::Cell;
use crate::record::{Opened, RecordError, Series};

/// What a checkpoint holds of it.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct OwnState {
    known: Known,
    mark: Option<Mark>,
    is_due: bool,
    is_over: bool,
}

impl OwnState {
    /// The guests of the run.
    pub fn known(&self) -> &Known {
        &self.known
    }

    /// Whether the run was ended by its rule.
    pub fn is_over(&self) -> bool {
        self.is_over
    }

    /// Opens the table, if there is one, and holds it to the checkpoint; nothing is changed.
    ///
    /// # Errors
    /// [`RecordError`] where it is missing, or not what it was.
    pub fn check(&self, folder: &RunFolder) -> Result<Option<Opened>, RecordError> {
        let path = folder.root().join(names::OWN);
        self.mark.map(|mark| Series::check(&path, &self.known.columns(), mark)).transpose()
    }

    /// What cannot be, if anything.
    pub fn fault(&self) -> Option<&'static str> {
        let has_table = !self.known.measures().is_empty();
        let has_looks = self.known.looks.is_some();
        let is_odd = self.mark.is_some() != has_table || (!has_looks && (self.is_due || self.is_over));
        is_odd.then_some("its own measures cannot be those of its run")
    }
}

/// The table of measures, and whether a look is due.
#[derive(Debug)]
pub struct Own {
    known: Known,
    series: Option<Series>,
    is_due: bool,
    is_over: bool,
}

impl Own {
    /// Makes the table's file, if there are measures.
    ///
    /// # Errors
    /// [`RecordError::File`].
    pub fn create(known: Known, folder: &RunFolder) -> Result<Self, RecordError> {
        let path = folder.root().join(names::OWN);
        let has_table = !known.measures().is_empty();
        let series = has_table.then(|| Series::create(&path, &known.columns())).transpose()?;
        Ok(Self { known, series, is_due: false, is_over: false })
    }

    /// Cuts the table back to its mark and goes on from there.
    ///
    /// # Errors
    /// [`RecordError::File`].
    pub fn resume(state: OwnState, opened: Option<Opened>) -> Result<Self, RecordError> {
        let OwnState { known, is_due, is_over, .. } = state;
        Ok(Self { known, series: opened.map(Opened::cut).transpose()?, is_due, is_over })
    }

    /// Where it stands; its rows are handed on before.
    pub fn state(&self) -> OwnState {
        let mark = self.series.as_ref().map(Series::mark);
        OwnState { known: self.known.clone(), mark, is_due: self.is_due, is_over: self.is_over }
    }

    /// The guests of the run.
    pub fn known(&self) -> &Known {
        &self.known
    }

    /// The other tables have a row that this one has not.
    pub fn ask(&mut self) {
        self.is_due = self.known.looks.is_some();
    }

    /// Whether a look is due.
    pub fn is_due(&self) -> bool {
        self.is_due
    }

    /// Whether the rule ended the run.
    pub fn is_over(&self) -> bool {
        self.is_over
    }

    /// Takes in what a look at a time [s] came to, and whether it ended the run.
    ///
    /// # Errors
    /// [`RecordError::File`].
    pub fn take(&mut self, time: f64, values: &[f64], is_over: bool) -> Result<(), RecordError> {
        (self.is_due, self.is_over) = (false, is_over);
        let Some(series) = &mut self.series else { return Ok(()) };
        let row: Vec<Cell<'_>> = std::iter::once(&time).chain(values).copied().map(Cell::Number).collect();
        series.row(row)
    }

    /// Hands its rows to the operating system.
    ///
    /// # Errors
    /// [`RecordError::File`].
    pub fn flush(&mut self) -> Result<(), RecordError> {
        self.series.as_mut().map_or(Ok(()), Series::flush)
    }

    /// Puts its rows onto the disk.
    ///
    /// # Errors
    /// [`RecordError::File`].
    pub fn sync(&mut self) -> Result<(), RecordError> {
        self.series.as_mut().map_or(Ok(()), Series::sync)
    }
}

/// What an onlooker sees of a run now.
///
/// # Errors
/// Why it cannot, or why what it gave cannot be, in words.
pub fn look<J: Job>(onlooker: &mut dyn Onlooker, known: &Known, job: &J) -> Result<Look, String> {
    validated(known, job.time(), job.show(|sight| onlooker.look(sight))?)
}

fn validated(known: &Known, time: f64, look: Look) -> Result<Look, String> {
    let measures = known.measures();
    let (found, due) = (look.values.len(), measures.len());
    if found != due {
        return Err(format!("t = {time:.6e} s: a look gave {found} values, and there are {due} measures"));
    }
    if let Some(at) = look.values.iter().position(|value| value.is_infinite()) {
        let name = &measures[at];
        let help = "give a finite number, or one that is not a number where there is none";
        return Err(format!("t = {time:.6e} s: the measure {name} is infinite; {help}"));
    }
    let has_rule = known.looks.as_ref().is_some_and(|looks| looks.has_rule);
    if look.is_over && !has_rule {
        return Err(format!("t = {time:.6e} s: a look ends the run, but has_rule() says that none does"));
    }
    Ok(look)
}
