from flexcage.warming.files import write_warmth as write_warmth
from flexcage.warming.loop import warm as warm
from flexcage.warming.warmth import Iteration as Iteration
from flexcage.warming.warmth import Warmth as Warmth

__all__ = ["Iteration", "Warmth", "warm", "write_warmth"]
