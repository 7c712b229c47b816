use super::{DEPTH, FormulaError, Function, Step, Variables};
use crate::case::suggest::nearest;

/// Longest formula that is read, in bytes.
const LONGEST: usize = 4096;
/// Most brackets and signs within each other.
const NESTED: usize = 64;

type One = Function<fn(f64) -> f64>;
type Two = Function<fn(f64, f64) -> f64>;

/// Functions of one argument.
const ONES: [One; 17] = [
    Function { name: "abs", call: f64::abs },
    Function { name: "acos", call: f64::acos },
    Function { name: "asin", call: f64::asin },
    Function { name: "atan", call: f64::atan },
    Function { name: "cos", call: f64::cos },
    Function { name: "cosh", call: f64::cosh },
    Function { name: "exp", call: f64::exp },
    Function { name: "floor", call: f64::floor },
    Function { name: "ln", call: f64::ln },
    Function { name: "log10", call: f64::log10 },
    Function { name: "sign", call: |x| if x == 0.0 { 0.0 } else { x.signum() } },
    Function { name: "sin", call: f64::sin },
    Function { name: "sinh", call: f64::sinh },
    Function { name: "sqrt", call: f64::sqrt },
    Function { name: "step", call: |x| if x.is_nan() { x } else { f64::from(x >= 0.0) } },
    Function { name: "tan", call: f64::tan },
    Function { name: "tanh", call: f64::tanh },
];

/// Functions of two arguments.
const TWOS: [Two; 4] = [
    Function { name: "atan2", call: f64::atan2 },
    Function { name: "hypot", call: f64::hypot },
    Function { name: "max", call: |a, b| if a > b || a.is_nan() { a } else { b } },
    Function { name: "min", call: |a, b| if a < b || a.is_nan() { a } else { b } },
];

const COMPARISONS: [Two; 4] = [
    Function { name: "<=", call: |a, b| f64::from(a <= b) },
    Function { name: ">=", call: |a, b| f64::from(a >= b) },
    Function { name: "<", call: |a, b| f64::from(a < b) },
    Function { name: ">", call: |a, b| f64::from(a > b) },
];

const SUMS: [Two; 2] =
    [Function { name: "+", call: |a, b| a + b }, Function { name: "-", call: |a, b| a - b }];

const PRODUCTS: [Two; 2] =
    [Function { name: "*", call: |a, b| a * b }, Function { name: "/", call: |a, b| a / b }];

const POWER: Two = Function { name: "^", call: f64::powf };
const NEGATIVE: One = Function { name: "-", call: |x| -x };

const CONSTANTS: [(&str, f64); 2] = [("pi", std::f64::consts::PI), ("e", std::f64::consts::E)];

/// Reads a formula from left to right, one function a level of the order of operations.
pub(super) struct Reader<'a> {
    text: &'a str,
    at: usize,
    variables: Variables,
    steps: Vec<Step>,
    /// Values that wait on the stack.
    height: usize,
    nested: usize,
}

type Outcome = Result<(), FormulaError>;

impl<'a> Reader<'a> {
    pub fn new(text: &'a str, variables: Variables) -> Self {
        Self { text, at: 0, variables, steps: Vec::new(), height: 0, nested: 0 }
    }

    pub fn formula(mut self) -> Result<Vec<Step>, FormulaError> {
        if self.text.len() > LONGEST {
            return Err(self.error(&format!("a formula of at most {LONGEST} bytes")));
        }
        self.comparison()?;
        self.skip_blanks();
        if self.at < self.text.len() {
            return Err(self.error("an operation, such as + - * / ^"));
        }
        Ok(self.steps)
    }

    fn comparison(&mut self) -> Outcome {
        self.sum()?;
        if let Some(operation) = self.take_one_of(&COMPARISONS) {
            self.sum()?;
            self.push(Step::Two(operation))?;
        }
        Ok(())
    }

    fn sum(&mut self) -> Outcome {
        self.product()?;
        while let Some(operation) = self.take_one_of(&SUMS) {
            self.product()?;
            self.push(Step::Two(operation))?;
        }
        Ok(())
    }

    fn product(&mut self) -> Outcome {
        self.signed()?;
        while let Some(operation) = self.take_one_of(&PRODUCTS) {
            self.signed()?;
            self.push(Step::Two(operation))?;
        }
        Ok(())
    }

    /// A power, with its sign: `-x^2` is `-(x^2)`, `2^-x` is allowed.
    fn signed(&mut self) -> Outcome {
        if self.take("-") {
            self.within(Self::signed)?;
            return self.push(Step::One(NEGATIVE));
        }
        if self.take("+") {
            return self.within(Self::signed);
        }
        self.value()?;
        if self.take("^") {
            self.within(Self::signed)?;
            self.push(Step::Two(POWER))?;
        }
        Ok(())
    }

    /// A number, a name, or what stands in brackets.
    fn value(&mut self) -> Outcome {
        self.skip_blanks();
        let rest = self.rest();
        if self.take("(") {
            self.within(Self::comparison)?;
            return self.expect(")");
        }
        if rest.starts_with(|c: char| c.is_ascii_digit() || c == '.') {
            return self.number();
        }
        let is_of_name = |c: char| c.is_alphanumeric() || c == '_';
        let name = &rest[..rest.find(|c| !is_of_name(c)).unwrap_or(rest.len())];
        if name.is_empty() {
            return Err(self.error("a number, a name or \"(\""));
        }
        self.named(name)
    }

    fn number(&mut self) -> Outcome {
        let bytes = self.rest().as_bytes();
        let digits = |from: usize| {
            from + bytes[from..].iter().take_while(|b| b.is_ascii_digit() || **b == b'.').count()
        };
        let mut end = digits(0);
        if bytes.get(end).is_some_and(|b| b.eq_ignore_ascii_case(&b'e')) {
            let sign = usize::from(bytes.get(end + 1).is_some_and(|b| matches!(b, b'+' | b'-')));
            if bytes.get(end + 1 + sign).is_some_and(u8::is_ascii_digit) {
                end = digits(end + 1 + sign);
            }
        }
        let number = self.rest()[..end].parse().ok().filter(|value: &f64| value.is_finite());
        let number = number.ok_or_else(|| self.error("a number such as 0.41 or 1e-3"))?;
        self.at += end;
        self.push(Step::Number(number))
    }

    fn named(&mut self, name: &str) -> Outcome {
        let step = match name {
            "x" => Some(Step::X),
            "y" => Some(Step::Y),
            "t" => Some(Step::Time),
            _ => CONSTANTS.iter().find(|c| c.0 == name).map(|c| Step::Number(c.1)),
        };
        if let Some(step) = step {
            let is_variable = !matches!(step, Step::Number(_));
            if is_variable && !self.variables.names().contains(&name) {
                return Err(self.unknown(name));
            }
            self.at += name.len();
            return self.push(step);
        }
        let one = ONES.iter().find(|f| f.name == name).map(|f| (1, Step::One(*f)));
        let two = TWOS.iter().find(|f| f.name == name).map(|f| (2, Step::Two(*f)));
        let three = (name == "if").then_some((3, Step::If));
        let call = one.or(two).or(three).ok_or_else(|| self.unknown(name))?;
        self.at += name.len();
        self.call(call)
    }

    fn call(&mut self, (arguments, step): (usize, Step)) -> Outcome {
        self.expect("(")?;
        for k in 0..arguments {
            if k > 0 {
                self.expect(",")?;
            }
            self.within(Self::comparison)?;
        }
        self.expect(")")?;
        self.push(step)
    }

    fn unknown(&self, name: &str) -> FormulaError {
        let functions = ONES.iter().map(|f| f.name).chain(TWOS.iter().map(|f| f.name));
        let constants = CONSTANTS.iter().map(|c| c.0);
        let variables = self.variables.names();
        let known: Vec<&str> = functions.chain(["if"]).chain(constants).collect();
        let longer = known.iter().copied().find(|word| word.starts_with(name));
        match longer.or_else(|| nearest(name, &known)).filter(|_| name.len() > 1) {
            Some(word) => self.error(&format!("a name that is known, such as {word},")),
            None => self.error(&format!("{} or a function", variables.join(", "))),
        }
    }

    /// Reads something that stands within something else.
    fn within(&mut self, read: fn(&mut Self) -> Outcome) -> Outcome {
        self.nested += 1;
        if self.nested > NESTED {
            return Err(
                self.error(&format!("at most {NESTED} brackets and signs within each other"))
            );
        }
        read(self)?;
        self.nested -= 1;
        Ok(())
    }

    fn push(&mut self, step: Step) -> Outcome {
        self.steps.push(step);
        match step {
            Step::One(_) => {}
            Step::Two(_) => self.height -= 1,
            Step::If => self.height -= 2,
            _ => self.height += 1,
        }
        if self.height > DEPTH {
            return Err(self.error("a formula with fewer values that wait for their operation"));
        }
        Ok(())
    }

    fn rest(&self) -> &'a str {
        &self.text[self.at..]
    }

    fn skip_blanks(&mut self) {
        self.at = self.text.len() - self.rest().trim_start().len();
    }

    fn take(&mut self, sign: &str) -> bool {
        self.skip_blanks();
        let found = self.rest().starts_with(sign);
        self.at += if found { sign.len() } else { 0 };
        found
    }

    fn take_one_of(&mut self, operations: &[Two]) -> Option<Two> {
        operations.iter().copied().find(|operation| self.take(operation.name))
    }

    fn expect(&mut self, sign: &str) -> Outcome {
        let or = if sign == "(" { "" } else { " or an operation" };
        if self.take(sign) { Ok(()) } else { Err(self.error(&format!("\"{sign}\"{or}"))) }
    }

    fn error(&self, expected: &str) -> FormulaError {
        let column = 1 + self.text[..self.at].chars().count();
        let found = self.rest().chars().take(20).collect::<String>().trim_end().to_owned();
        FormulaError { column, found, expected: expected.to_owned() }
    }
}
