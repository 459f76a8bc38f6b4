//! Columns of grains as arrays of NumPy.

use agglo::particles::{ColumnValues, Particles};
use agglo::record::frames::name_with_unit;
use numpy::{IntoPyArray, PyArray1, PyArray2, PyArrayMethods};
use pyo3::prelude::*;
use pyo3::types::PyDict;

/// All columns of grains by their names with units, as copies in the order of their ids.
pub(crate) fn columns<'py>(py: Python<'py>, grains: &Particles) -> PyResult<Bound<'py, PyDict>> {
    let mut order: Vec<u32> = (0..grains.len() as u32).collect();
    order.sort_by_key(|&at| grains.id[at as usize]);
    let table = PyDict::new(py);
    for (column, values) in grains.columns() {
        let name = name_with_unit(column.name, column.unit);
        match values {
            ColumnValues::Integers(values) => table.set_item(name, integers(py, sorted(values, &order)))?,
            ColumnValues::Scalars(values) => table.set_item(name, scalars(py, sorted(values, &order)))?,
            ColumnValues::Vectors(values) => table
                .set_item(name, vectors(py, sorted(values, &order).iter().map(|value| value.to_array()))?)?,
        }
    }
    Ok(table)
}

fn sorted<T: Copy>(values: &[T], order: &[u32]) -> Vec<T> {
    order.iter().map(|&at| values[at as usize]).collect()
}

/// [n] unsigned integers.
pub(crate) fn integers(py: Python<'_>, values: Vec<u32>) -> Bound<'_, PyArray1<u32>> {
    values.into_pyarray(py)
}

/// [n] numbers.
pub(crate) fn scalars(py: Python<'_>, values: Vec<f64>) -> Bound<'_, PyArray1<f64>> {
    values.into_pyarray(py)
}

/// [n, 3] numbers.
pub(crate) fn vectors(
    py: Python<'_>,
    values: impl IntoIterator<Item = [f64; 3]>,
) -> PyResult<Bound<'_, PyArray2<f64>>> {
    let rows: Vec<[f64; 3]> = values.into_iter().collect();
    let count = rows.len();
    rows.into_flattened().into_pyarray(py).reshape([count, 3])
}
