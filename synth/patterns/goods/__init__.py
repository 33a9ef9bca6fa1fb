"""What is made of card, by its parameters: pop-ups and cartons."""
