from synth.templates.paper import Paper as Paper, paper_named as paper_named
from synth.templates.solids import write_solids as write_solids
from synth.templates.template import Template as Template, pictured as pictured, template_of as template_of
from synth.templates.things import panels_of_thing as panels_of_thing
from synth.templates.writing import write_template as write_template
