from flexcage.bearings.tapered_roller.statics import rollers_of as statics

__all__ = ["statics"]
