use std::ops::{Add, AddAssign, Div, Mul, Sub};

/// A complex number.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Complex {
    /// Real part.
    pub re: f64,
    /// Imaginary part.
    pub im: f64,
}

impl Complex {
    /// From its two parts.
    pub const fn new(re: f64, im: f64) -> Self {
        Self { re, im }
    }

    /// From modulus and phase in radians.
    pub fn from_polar(modulus: f64, phase_rad: f64) -> Self {
        Self::new(modulus * phase_rad.cos(), modulus * phase_rad.sin())
    }

    /// Modulus.
    pub fn modulus(self) -> f64 {
        self.re.hypot(self.im)
    }

    /// Square of the modulus.
    pub fn squared_modulus(self) -> f64 {
        self.re * self.re + self.im * self.im
    }

    /// Phase, radians, in (−π, π].
    pub fn phase_rad(self) -> f64 {
        self.im.atan2(self.re)
    }

    /// The square root with a non-negative real part.
    pub(crate) fn sqrt(self) -> Self {
        let modulus = self.modulus();
        let re = (0.5 * (modulus + self.re)).max(0.0).sqrt();
        let im = (0.5 * (modulus - self.re)).max(0.0).sqrt();
        Self::new(re, if self.im < 0.0 { -im } else { im })
    }
}

impl Add for Complex {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        Self::new(self.re + other.re, self.im + other.im)
    }
}

impl AddAssign for Complex {
    fn add_assign(&mut self, other: Self) {
        *self = *self + other;
    }
}

impl Sub for Complex {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        Self::new(self.re - other.re, self.im - other.im)
    }
}

impl Mul for Complex {
    type Output = Self;
    fn mul(self, other: Self) -> Self {
        Self::new(self.re * other.re - self.im * other.im, self.re * other.im + self.im * other.re)
    }
}

impl Div for Complex {
    type Output = Self;
    fn div(self, other: Self) -> Self {
        let d = other.squared_modulus();
        Self::new(
            (self.re * other.re + self.im * other.im) / d,
            (self.im * other.re - self.re * other.im) / d,
        )
    }
}
