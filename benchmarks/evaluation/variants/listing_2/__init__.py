"""CO-SLEEC in the programming model of Listing 2: a method for each rule, with a variant for each clause."""
