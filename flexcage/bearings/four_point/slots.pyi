from flexcage.bearings.four_point.statics import four_point_balls_of as statics

__all__ = ["statics"]
