//! Pages of laws and methods: their examples are read, words lead to the right one, and the guide has what they say.

#![allow(clippy::unwrap_used, reason = "a test that cannot read its files has failed")]

#[macro_use]
extern crate agglo_testing;

mod fragments;
mod guide;
mod words;
