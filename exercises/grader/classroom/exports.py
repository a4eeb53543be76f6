"""interim"""
def write_all(*a): pass
