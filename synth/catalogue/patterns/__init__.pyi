from synth.catalogue.patterns._generate import Generated as Generated, generate as generate
from synth.catalogue.patterns.generator import Generator as Generator, Parameter as Parameter
from synth.catalogue.patterns.generators import GENERATORS as GENERATORS
