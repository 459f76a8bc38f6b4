//! Columns of grains as arrays of NumPy.

use agglo::math::Vec3;
use agglo::particles::{ById, ColumnValues, Particles};
use agglo::record::frames::name_with_unit;
use numpy::{IntoPyArray, PyArray1, PyArray2, PyArrayMethods, PyUntypedArrayMethods};
use pyo3::prelude::*;
use pyo3::sync::PyOnceLock;
use pyo3::types::PyDict;

/// All columns of grains by their names with units, as copies in the order of their ids.
pub(crate) fn columns<'py>(py: Python<'py>, grains: &Particles) -> PyResult<Bound<'py, PyDict>> {
    let order: Vec<u32> = ById::of(&grains.id).places().collect();
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

/// An array [n, 3] that is filled again where nobody has kept it: memory that comes and goes is dearer than what is put into it.
#[derive(Default)]
pub(crate) struct Vectors(Option<Py<PyArray2<f64>>>);

impl Vectors {
    /// The values of an order.
    pub(crate) fn filled<'py>(
        &mut self,
        py: Python<'py>,
        values: &[Vec3],
        order: &[u32],
    ) -> PyResult<Bound<'py, PyArray2<f64>>> {
        let shape = [order.len(), 3];
        let own = self.0.take().map(|array| array.into_bound(py));
        let array = match own {
            Some(array) if array.shape() == shape && is_alone(&array)? && array.try_readwrite().is_ok() => {
                array
            }
            _ => PyArray2::zeros(py, shape, false),
        };
        let mut rows = array.try_readwrite()?;
        let (rows, _) = rows.as_slice_mut()?.as_chunks_mut::<3>();
        for (row, &at) in rows.iter_mut().zip(order) {
            *row = values[at as usize].to_array();
        }
        self.0 = Some(array.clone().unbind());
        Ok(array)
    }
}

/// Whether nobody else keeps an array, be it by a view.
fn is_alone(array: &Bound<'_, PyAny>) -> PyResult<bool> {
    // How many references the question itself holds is a matter of the interpreter: an object of ours alone tells.
    static ALONE: PyOnceLock<usize> = PyOnceLock::new();
    let py = array.py();
    let alone = ALONE.get_or_try_init(py, || references(PyDict::new(py).as_any()))?;
    Ok(references(array)? == *alone)
}

fn references(object: &Bound<'_, PyAny>) -> PyResult<usize> {
    static COUNT: PyOnceLock<Py<PyAny>> = PyOnceLock::new();
    COUNT.import(object.py(), "sys", "getrefcount")?.call1((object,))?.extract()
}
