//! Columns of tables. Each is declared once, in one line: its name, unit, label in words and meaning, whether it may be empty,
//! and how it is taken from what a row tells of. What writes, reads, draws and describes tables goes by these lines.

use std::fmt;

use crate::folder::names;
use crate::ledger::{Balance, Entry};

/// An entry of a row.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Cell<'a> {
    /// A quantity.
    Number(f64),
    /// An id or a count.
    Count(u64),
    /// A word.
    Word(&'a str),
    /// What cannot be had.
    Unknown,
}

/// What is told of a column.
#[derive(Clone, Copy, Debug)]
pub struct About {
    /// Its name in files, which ends with its unit: `kinetic_J`.
    pub name: &'static str,
    /// Its unit; empty for pure numbers, ids, counts and words.
    pub unit: &'static str,
    /// What people call it: in legends, on the dashboard.
    pub label: &'static str,
    /// What there is to be said besides; may be empty.
    pub meaning: &'static str,
    /// Whether there may be nothing to be told. In all other columns, and anything infinite, that is an error.
    pub may_be_empty: bool,
    /// Whether its entries are words.
    pub is_word: bool,
    /// Whether it is a part of a whole, which people read in percent.
    pub is_part: bool,
    /// The chart that shows it over time.
    pub panel: Option<&'static Panel>,
    /// Its place among what is told of a run while it goes on.
    pub glance: Option<Glance>,
}

/// A chart over time, of columns of one table that share a unit.
#[derive(Debug, PartialEq, Eq)]
pub struct Panel {
    /// Name in the page.
    pub id: &'static str,
    /// Heading.
    pub title: &'static str,
    /// What it shows.
    pub about: &'static str,
    /// What its vertical axis counts.
    pub label: &'static str,
    /// In which unit.
    pub unit: &'static str,
}

/// How a column is told of while a run goes on.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Glance {
    /// Its place, from 1.
    pub place: u8,
    /// Whether its course is drawn as well.
    pub has_curve: bool,
}

/// How an entry is taken from what a row tells of.
enum Take<S> {
    Number(fn(&S) -> f64),
    NumberOrNone(fn(&S) -> Option<f64>),
    Count(fn(&S) -> u64),
    CountOrNone(fn(&S) -> Option<u64>),
    Word(fn(&S) -> &str),
    Entry(fn(&S) -> &Balance, fn(&Balance) -> f64),
}

/// A column of rows that tell of an `S`.
pub struct Column<S> {
    /// What is told of it.
    pub about: About,
    take: Take<S>,
}

impl<S> Column<S> {
    const fn new([name, unit, label, meaning]: [&'static str; 4], take: Take<S>) -> Self {
        let may_be_empty = matches!(take, Take::NumberOrNone(_) | Take::CountOrNone(_));
        let is_word = matches!(take, Take::Word(_));
        let (is_part, panel, glance) = (false, None, None);
        let about = About { name, unit, label, meaning, may_be_empty, is_word, is_part, panel, glance };
        Self { about, take }
    }

    /// The same, shown in a chart.
    pub(crate) const fn on(mut self, panel: &'static Panel) -> Self {
        self.about.panel = Some(panel);
        self
    }

    /// The same, a part of a whole.
    pub(crate) const fn part(mut self) -> Self {
        self.about.is_part = true;
        self
    }

    /// The same, told of at this place while a run goes on.
    pub(crate) const fn glance(mut self, place: u8) -> Self {
        self.about.glance = Some(Glance { place, has_curve: false });
        self
    }

    /// The same with its course.
    pub(crate) const fn glance_with_curve(mut self, place: u8) -> Self {
        self.about.glance = Some(Glance { place, has_curve: true });
        self
    }

    /// The entry of a row.
    pub fn cell<'a>(&self, of: &'a S) -> Cell<'a> {
        match self.take {
            Take::Number(take) => Cell::Number(take(of)),
            Take::NumberOrNone(take) => take(of).map_or(Cell::Unknown, Cell::Number),
            Take::Count(take) => Cell::Count(take(of)),
            Take::CountOrNone(take) => take(of).map_or(Cell::Unknown, Cell::Count),
            Take::Word(take) => Cell::Word(take(of)),
            Take::Entry(balance, take) => Cell::Number(take(balance(of))),
        }
    }
}

/// A quantity that every row has.
pub(crate) const fn number<S>(
    name: &'static str,
    unit: &'static str,
    label: &'static str,
    meaning: &'static str,
    take: fn(&S) -> f64,
) -> Column<S> {
    Column::new([name, unit, label, meaning], Take::Number(take))
}

/// A quantity that not every row has.
pub(crate) const fn number_or_none<S>(
    name: &'static str,
    unit: &'static str,
    label: &'static str,
    meaning: &'static str,
    take: fn(&S) -> Option<f64>,
) -> Column<S> {
    Column::new([name, unit, label, meaning], Take::NumberOrNone(take))
}

/// A count or an id that every row has.
pub(crate) const fn count<S>(
    name: &'static str,
    label: &'static str,
    meaning: &'static str,
    take: fn(&S) -> u64,
) -> Column<S> {
    Column::new([name, "", label, meaning], Take::Count(take))
}

/// A count or an id that not every row has.
pub(crate) const fn count_or_none<S>(
    name: &'static str,
    label: &'static str,
    meaning: &'static str,
    take: fn(&S) -> Option<u64>,
) -> Column<S> {
    Column::new([name, "", label, meaning], Take::CountOrNone(take))
}

/// A word that every row has.
pub(crate) const fn word<S>(
    name: &'static str,
    label: &'static str,
    meaning: &'static str,
    take: fn(&S) -> &str,
) -> Column<S> {
    Column::new([name, "", label, meaning], Take::Word(take))
}

/// An entry of the ledger, which has said what is to be told of it.
pub(crate) const fn entry<S>(told: &Entry, balance: fn(&S) -> &Balance) -> Column<S> {
    Column::new([told.name, told.unit, told.label, told.meaning], Take::Entry(balance, told.of))
}

/// A table whose rows tell of an `S`.
pub struct Table<S: 'static> {
    /// Its place in the folder.
    pub file: &'static str,
    /// Its columns.
    pub columns: &'static [Column<S>],
}

/// A table, whatever its rows tell of.
pub trait Declared: Sync {
    /// Its place in the folder.
    fn file(&self) -> &'static str;

    /// What is told of its columns, in their order.
    fn columns(&self) -> Vec<&'static About>;

    /// Its name, where it is one of those over time.
    fn series(&self) -> Option<&'static str> {
        names::of_series(self.file())
    }

    /// Names of its columns.
    fn names(&self) -> Vec<&'static str> {
        self.columns().iter().map(|column| column.name).collect()
    }
}

impl<S: 'static> Declared for Table<S> {
    fn file(&self) -> &'static str {
        self.file
    }

    fn columns(&self) -> Vec<&'static About> {
        self.columns.iter().map(|column| &column.about).collect()
    }
}

impl fmt::Debug for dyn Declared {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.file())
    }
}

/// Tables, in the order in which they are written.
pub type Tables = &'static [&'static dyn Declared];
