//! Eigenvalues and eigenvectors of small symmetric matrices: cyclic Jacobi rotations.
//!
//! Plain loops in a fixed order, so that a search gives the same bits on every machine.
//!
//! Source: G. H. Golub and C. F. Van Loan, *Matrix Computations*, 4th ed. (2013), section 8.5.

/// Sweeps after which it gives up; convergence is quadratic and takes fewer than ten.
const SWEEPS: usize = 60;

/// Turns `matrix` `[d, d]` into a diagonal one and `vectors` `[d, d]` into its eigenvectors, one a column.
///
/// `vectors` holds an orthonormal basis on entry, which is turned along: `matrix` is seen in that basis.
pub(super) fn diagonalize(matrix: &mut [f64], vectors: &mut [f64], dimensions: usize) {
    for _ in 0..SWEEPS {
        let mut turned = false;
        for p in 0..dimensions {
            for q in p + 1..dimensions {
                turned |= rotate(matrix, vectors, dimensions, [p, q]);
            }
        }
        if !turned {
            return;
        }
    }
}

/// Makes entry (p, q) zero; whether it was not.
fn rotate(matrix: &mut [f64], vectors: &mut [f64], dimensions: usize, [p, q]: [usize; 2]) -> bool {
    let at = |row: usize, column: usize| row * dimensions + column;
    let (first, second, across) = (matrix[at(p, p)], matrix[at(q, q)], matrix[at(p, q)]);
    // Below this it changes no digit of either eigenvalue.
    if across.abs() <= 1e-17 * (first * second).abs().sqrt() || across == 0.0 {
        return false;
    }
    let ratio = (second - first) / (2.0 * across);
    let tangent = ratio.signum() / (ratio.abs() + ratio.hypot(1.0));
    let cosine = 1.0 / tangent.hypot(1.0);
    let sine = tangent * cosine;
    for k in 0..dimensions {
        let (a, b) = (matrix[at(k, p)], matrix[at(k, q)]);
        matrix[at(k, p)] = cosine * a - sine * b;
        matrix[at(k, q)] = sine * a + cosine * b;
        let (a, b) = (vectors[at(k, p)], vectors[at(k, q)]);
        vectors[at(k, p)] = cosine * a - sine * b;
        vectors[at(k, q)] = sine * a + cosine * b;
    }
    for k in 0..dimensions {
        let (a, b) = (matrix[at(p, k)], matrix[at(q, k)]);
        matrix[at(p, k)] = cosine * a - sine * b;
        matrix[at(q, k)] = sine * a + cosine * b;
    }
    (matrix[at(p, q)], matrix[at(q, p)]) = (0.0, 0.0);
    true
}

/// The unit matrix `[d, d]`.
pub(super) fn identity(dimensions: usize) -> Vec<f64> {
    let mut matrix = vec![0.0; dimensions * dimensions];
    matrix.iter_mut().step_by(dimensions + 1).for_each(|entry| *entry = 1.0);
    matrix
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The second-difference matrix with 2 on and -1 beside its diagonal has 2 - 2 cos(k π/(d + 1)), k = 1 ... d.
    #[test]
    fn second_differences() {
        let d = 12;
        let mut matrix = vec![0.0; d * d];
        for i in 0..d {
            matrix[i * d + i] = 2.0;
            if i + 1 < d {
                matrix[i * d + i + 1] = -1.0;
                matrix[(i + 1) * d + i] = -1.0;
            }
        }
        let original = matrix.clone();
        let mut vectors = identity(d);
        diagonalize(&mut matrix, &mut vectors, d);
        let mut values: Vec<f64> = matrix.iter().step_by(d + 1).copied().collect();
        for (k, value) in values.iter().enumerate() {
            for i in 0..d {
                let product: f64 = (0..d).map(|j| original[i * d + j] * vectors[j * d + k]).sum();
                // Round-off of some hundred rotations of numbers up to 4.
                assert_near!(product, value * vectors[i * d + k], 1e-13);
            }
        }
        values.sort_by(f64::total_cmp);
        for (k, value) in values.iter().enumerate() {
            let angle = (k + 1) as f64 * std::f64::consts::PI / (d + 1) as f64;
            assert_near!(*value, 2.0 - 2.0 * angle.cos(), 1e-13);
        }
    }
}
