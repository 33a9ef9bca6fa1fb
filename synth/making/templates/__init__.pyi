from synth.making.templates.hinges import Hinges as Hinges
from synth.making.templates.pages import Paper as Paper, paper_named as paper_named
from synth.making.templates.solids import write_solids as write_solids
from synth.making.templates.template import (
    Template as Template,
    panels_of_mechanism as panels_of_mechanism,
    pictured as pictured,
    template_of as template_of,
)
from synth.making.templates.writing import write_template as write_template
