from synth.patterns.catalogue import GENERATORS as GENERATORS
from synth.patterns.generated import Generated as Generated, generate as generate
from synth.patterns.generator import Generator as Generator, Parameter as Parameter
